# The adaptive area light against POV-Ray's, on the same views of the same scenes and light.

views="three-spheres bridge table"

# first_light SCENE: the first light of a scene file as a --light SPEC.
first_light() {
  awk '/"type": "sphere", "position"/ {
    gsub(/.*"position": \[|, "radiance.*| /, ""); gsub(/\],"radius":/, ",")
    print "sphere:" $0 ",20"
    exit
  }' "$1"
}

# our_picture SCENE NAME [options…]: NAME.png, lit by $light alone.
our_picture() {
  scene=$1 name=$2
  shift 2
  "$bin/penumbra" render "$scene" -o "$name.png" --quiet --spp 1 --size "${picture}x$picture" \
    --threads 2 --no-scene-lights --light "$light" --shadows area "$@"
}

# pov_picture SCENE.pov SHADOWS OUT [options…]
pov_picture() {
  source=$1 shadows=$2 out=$3
  shift 3
  povray "+I$source" "+O$out" "Declare=Shadows=$shadows" "+W$picture" "+H$picture" -D -V -A +WT2 "$@"
}

# whole_times SCENE NAME: whole processes, taking turns; "OURS THEIRS" a line.
whole_times() {
  round=0
  while [ "$round" -le "$repeats" ]; do
    ours=$(wall_seconds our_picture "$1" "$2" --error 0.01)
    theirs=$(wall_seconds pov_picture "$2.pov" 2 "$2-pov.png" +FN)
    [ "$round" = 0 ] || say "$ours $theirs"
    round=$((round + 1))
  done
}

# pov_count LOG LABEL: a number of POV-Ray's statistics.
pov_count() { sed -n "s/^$2: *\([0-9]*\).*/\1/p" "$1" | head -n 1; }

# measure_povray SCENE NAME: pictures, counts, times and errors; NAME.tsv.
measure_povray() {
  light=$(first_light "$1")
  "$bin/to_povray" "$1" >"$2.pov"
  our_picture "$1" "$2-reference" --light-samples "$reference_points" --seed 1 \
    --aov "visibility=$2-reference.exr"
  our_picture "$1" "$2" --error 0.01 --aov "visibility=$2.exr" --stats "$2.json"
  pov_picture "$2.pov" 0 "$2-unshadowed.exr" +FE >"$2-unshadowed.log" 2>&1
  pov_picture "$2.pov" 2 "$2-shadowed.exr" +FE >"$2.log" 2>&1
  "$bin/compare_visibility" "$1" "$2-reference.exr" "$2.exr" "$2-shadowed.exr" \
    "$2-unshadowed.exr" >"$2.tsv"
  whole_times "$1" "$2" >"$2.times"
  our_rays=$(calc "$(json_number "$2.json" primary) + $(json_number "$2.json" shadow) + \
    $(json_number "$2.json" queries)")
  pov_rays=$(calc "$(pov_count "$2.log" Rays) + $(pov_count "$2.log" 'Shadow Ray Tests')")
  {
    printf 'our_rays\t%s\n' "$(calc "$our_rays / $picture / $picture")"
    printf 'pov_rays\t%s\n' "$(calc "$pov_rays / $picture / $picture")"
    printf 'our_seconds\t%s\n' "$(awk '{ print $1 }' "$2.times" | median)"
    printf 'pov_seconds\t%s\n' "$(awk '{ print $2 }' "$2.times" | median)"
    printf 'faster\t%s\n' "$(awk '{ print $2 / $1 }' "$2.times" | median)"
    printf 'rmse\t%s\n' "$(calc "$(named "$2.tsv" our_rmse) / $(named "$2.tsv" pov_rmse)")"
    printf 'rays\t%s\n' "$(calc "$our_rays / $pov_rays")"
  } >>"$2.tsv"
}

# povray_scene_rows NAME
povray_scene_rows() {
  file=$work/$1.tsv
  row "area --error 0.01 / POV-Ray, penumbra RMSE, $1" - "$(named "$file" rmse)" 1 1 most
  row "the same, rays a pixel, $1" - "$(named "$file" rays)" 1 0.5 most
  row "POV-Ray / the same, whole process, $1" - "$(named "$file" faster)" 4 15 least
}

# povray_details: the section under the table.
povray_details() {
  say ""
  say "POV-Ray's area light: 17 x 17, adaptive 1, jitter, circular, orient. The error is that of" \
    "the visible fraction against $reference_points light points, over the penumbra. Rays are all" \
    "that are traced: ours count primary and shadow rays and cones. The cameras agree: the share" \
    "of lit pixels that show the same point in both is in the last column."
  say ""
  say "| scene | RMSE | POV-Ray's | rays a pixel | POV-Ray's | seconds | POV-Ray's | same point |"
  say "|---|---|---|---|---|---|---|---|"
  for view in $views; do
    file=$work/$view.tsv
    say "| $view | $(named "$file" our_rmse) | $(named "$file" pov_rmse) |" \
      "$(named "$file" our_rays) | $(named "$file" pov_rays) | $(named "$file" our_seconds) |" \
      "$(named "$file" pov_seconds) | $(named "$file" same_point) |"
  done
}

povray_rows() {
  if ! command -v povray >/dev/null 2>&1; then
    note "there is no povray: its rows are left out"
    printf '\nThe rows against POV-Ray are missing: it was not installed.\n' >>"$details"
    return 0
  fi
  for view in $views; do
    note "POV-Ray: $view"
    measure_povray "tests/data/oracle/$view.json" "$work/$view"
    povray_scene_rows "$view"
  done
  povray_details >>"$details"
}
