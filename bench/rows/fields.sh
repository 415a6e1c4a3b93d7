# Distance fields: whole pictures by our processor and by llvmpipe, two threads.

# measure_fields NAME [arguments…]: NAME.tsv
measure_fields() {
  note "distance fields: $1"
  fields_file=$work/$1.tsv
  shift
  "$bin/bench_fields" --threads 2 "$@" >"$fields_file" || die "bench_fields failed: $*"
}

# measure_llvmpipe NAME [arguments…]: NAME-256.tsv and NAME-512.tsv, by the width of its vectors.
measure_llvmpipe() {
  drawn=$1
  shift
  measure_fields "$drawn-256" --gl "$@"
  LP_NATIVE_VECTOR_WIDTH=512 && export LP_NATIVE_VECTOR_WIDTH
  measure_fields "$drawn-512" --gl "$@"
  unset LP_NATIVE_VECTOR_WIDTH
}

# field_row WHAT NAME VALUE MUST AIM most|least
field_row() { row "$1" - "$(named "$work/$2.tsv" "$3")" "$4" "$5" "$6"; }

# llvmpipe_row WHAT NAME METHOD MUST AIM: over the faster of its widths.
llvmpipe_row() {
  row "$1, $3" - "$(for width in 256 512; do
    named "$work/$2-$width.tsv" "gl_over_cpu/$3"
    say ""
  done | sed '/^$/d' | sort -g | head -n 1)" "$4" "$5" least
}

overhead_field_rows() {
  for method in classic improved inner; do
    must=1.05 aim=1.01 must_gl=1.05
    [ $method != inner ] || must=1.30 aim=1.10 must_gl=1.21
    field_row "picture of 8 shapes, sdf-$method / the plain march, our processor" eight-512 \
      "cpu/${method}_over_hard" $must $aim most
    field_row "the same, llvmpipe" eight-512 "gl/${method}_over_hard" $must_gl $aim most
  done
}

field_details() {
  say ""
  say "Distance fields: whole pictures, one sample a pixel, by \`bench/bench_fields\`; a floor and" \
    "boxes, balls and tori under a sphere light. Hard is the plain published march (\`--variant" \
    "march\`). llvmpipe draws our GLSL of the same scene in one draw and one finish; of its two" \
    "vector widths the faster counts. The pictures of 1,000 blended shapes are $blended_size" \
    "pixels, those of 8 shapes $field_size. The last column: pixels that differ by more than one" \
    "code of 255 between the devices."
  say ""
  say "| scene | method | our ms | llvmpipe's ms, 8 wide | 16 wide | differ |"
  say "|---|---|---|---|---|---|"
  for part in eight:hard eight:classic eight:improved eight:inner blended:classic; do
    drawn=${part%:*} method=${part#*:}
    file=$work/$drawn-512.tsv
    say "| $drawn | $method | $(calc "1000 * $(named "$file" "cpu/$method")") |" \
      "$(calc "1000 * $(named "$work/$drawn-256.tsv" "gl/$method")") |" \
      "$(calc "1000 * $(named "$file" "gl/$method")") |" \
      "$(calc "100 * $(named "$file" "differing/$method")") % |"
  done
}

field_rows() {
  if [ -n "$quick" ]; then
    field_size=256x144 blended_size=64x36
  else
    field_size=1280x720 blended_size=640x360
  fi
  measure_llvmpipe eight --shapes 8 --size $field_size --repeats $((2 * repeats))
  measure_llvmpipe blended --shapes 1000 --smooth --size $blended_size --repeats 1 --method classic
  measure_fields spread --shapes 1000 --against 10 --size $field_size --repeats $((2 * repeats))
  overhead_field_rows
  for method in hard classic improved; do
    llvmpipe_row "llvmpipe / our processor, picture of 8 shapes" eight $method 2.5 8
  done
  llvmpipe_row "llvmpipe / our processor, 1,000 blended shapes" blended classic 20 100
  for method in hard classic improved; do
    field_row "our processor, 1,000 / 10 shapes over the same picture, $method" spread \
      "more_over_fewer/$method" 6 3 most
  done
  for blend in "" --smooth; do
    measure_fields "memory$blend" --shapes 10000 $blend --repeats 0
    row "memory of 10,000 shapes${blend:+, blended}, MB" - \
      "$(named "$work/memory$blend.tsv" megabytes)" 100 30 most "%.1f"
  done
  field_details >>"$details"
}
