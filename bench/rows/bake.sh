# Radiance textures: Heckbert and Herf's workloads, a floor under a model, and a whole room.

# measure_bakes WORKLOAD: bake-WORKLOAD-1.tsv and -2.tsv, by the number of threads.
measure_bakes() {
  note "baking: $1"
  for threads in 1 2; do
    # shellcheck disable=SC2086 # an option or none
    "$bin/bench_bake" ${quick:+--quick} --threads $threads --only "$1" \
      >"$work/bake-$1-$threads.tsv" || die "bench_bake failed: $1"
  done
}

# baked WORKLOAD THREADS NAME
baked() { named "$work/bake-$1-$2.tsv" "$3"; }

# time_row WHAT WORKLOAD NAME MUST AIM: milliseconds; the limits hold for two threads.
time_row() {
  row "$1" - "$(calc "1000 * $(baked "$2" 2 "$3")")" "$4" "$5" most "%.2f ms"
}

# bake_stats FILE OPTIONS…: bakes once with two threads; statistics into FILE.
bake_stats() {
  stats_file=$1
  shift
  "$bin/penumbra" bake "$@" --threads 2 --quiet --stats "$stats_file" -o "$work/baked.glb" \
    2>"$work/log" || { cat "$work/log" >&2; die "penumbra bake $* failed"; }
}

# sample_rows: memory is that of the whole process.
sample_rows() {
  row "time a sample, 512 / 8 samples" - "$(baked samples 2 "time a sample, most / fewest")" 1.1 1 \
    most
  for samples in 8 512; do
    bake_stats "$work/memory-$samples.json" scenes/room.json --light-samples $samples \
      --device cpu --texel-size 0.01
  done
  row "memory, 512 / 8 samples, scenes/room.json" - "$(calc "$(json_number \
    "$work/memory-512.json" peak_bytes) / $(json_number "$work/memory-8.json" \
    peak_bytes)")" 1.1 1.01 most
}

# floor_rows: 512² texels under a model, sphere light, 64 samples.
floor_rows() {
  get_small_model
  note "baking: a floor under $model"
  "$bin/bench_bake" ${quick:+--quick} --threads 2 --model "$work/small.ply" >"$work/floor.tsv" ||
    die "bench_bake failed: $model"
  row "floor of 512 x 512 texels under $model (11k triangles), sphere light, 64 samples" - \
    "$(calc "1000 * $(named "$work/floor.tsv" floor)")" - - most "%.1f ms"
}

# cycles_rows: the same floor by Blender, if it is there; after floor_rows.
cycles_rows() {
  command -v blender >/dev/null || return 0
  note "baking: the same floor by Blender's Cycles"
  blender -b --factory-startup -P bench/cycles_floor.py -- "$work/small.ply" "$work/cycles.raw" 64 \
    2 >"$work/log" 2>&1 || { cat "$work/log" >&2; die "blender failed"; }
  grep '^cycles' "$work/log" >"$work/cycles.tsv"
  "$bin/bench_bake" ${quick:+--quick} --threads 2 --model "$work/small.ply" \
    --against "$work/cycles.raw" >"$work/floor.tsv" || die "bench_bake failed: $model"
  row "the same floor by Cycles / by us, at no greater error" - \
    "$(calc "$(named "$work/cycles.tsv" cycles) / \
    $(named "$work/floor.tsv" "floor of no greater error")")" 30 150 least "%.0f x"
}

# kitchen_rows: the whole file of --kitchen, once by each device.
kitchen_rows() {
  [ -n "$kitchen" ] || return 0
  note "baking: $kitchen"
  for device in auto cpu rays; do
    bake_stats "$work/$device.json" "$kitchen" --device $device --light-samples 64 \
      --texel-size "$kitchen_texel"
    json_number "$work/$device.json" bake
  done | paste -s -d ' ' >"$work/devices"
  row "$(basename "$kitchen"), all receivers, 64 samples: auto / the better of cpu and rays" - \
    "$(awk '{ print $1 / ($2 < $3 ? $2 : $3) }' "$work/devices")" 1.1 0.5 most
}

bake_details() {
  say ""
  say "Baking: rooms as large as those of Heckbert and Herf (1997, sections 5 and 6), rebuilt, by" \
    "\`bench/bench_bake\`: triangles that moved to irradiance in memory, every structure built anew," \
    "on the processor (\`--device cpu\`). The limits are for two threads. In brackets what the paper" \
    "measured. For the exponent all polygons receive, at the same number of texels together," \
    "$(if [ -n "$quick" ]; then say "from 1k to 4k"; else say "from 1k to 64k"; fi) polygons."
  say ""
  say "| workload | one thread, ms | two threads, ms |"
  say "|---|---|---|"
  for part in rebake:rebake "light:fine light" table:table; do
    set -- "${part%%:*}" "${part#*:}"
    what=$(sed -n "s/^$2: \(.*\): .*/\1/p" "$work/bake-$1-2.tsv")
    say "| $what | $(calc "1000 * $(baked "$1" 1 "$2")") | $(calc "1000 * $(baked "$1" 2 "$2")") |"
  done
  for workload in scaling samples; do
    grep ' ms' "$work/bake-$workload-1.tsv" >"$work/ones"
    grep ' ms' "$work/bake-$workload-2.tsv" >"$work/twos"
    paste -d '\n' "$work/ones" "$work/twos" | awk '
      { what = $0; sub(/: [0-9.]+ ms.*/, "", what); ms = $0; sub(/ ms.*/, "", ms); sub(/.* /, "", ms) }
      NR % 2 { one = ms; next }
      { printf "| %s | %s | %s |\n", what, one, ms }'
  done
  [ -z "$kitchen" ] || {
    say ""
    say "$(basename "$kitchen"), texels of $kitchen_texel m, one bake each, seconds by auto, cpu and" \
      "rays: $(cat "$work/devices")."
  }
  say ""
  if [ -s "$work/cycles.tsv" ]; then
    say "The floor by $(blender --version 2>/dev/null | head -n 1), Cycles on the processor, two" \
      "threads, 64 samples, without denoising: $(named "$work/cycles.tsv" cycles) s, root mean" \
      "square error $(named "$work/floor.tsv" "error of the other") of the brightest texel against" \
      "65,536 points; by us with $(named "$work/floor.tsv" points) points:" \
      "$(named "$work/floor.tsv" "floor of no greater error") s, $(named "$work/floor.tsv" error)."
  else
    say "The floor is not compared with Blender's Cycles: \`blender\` is not there."
  fi
}

bake_rows() {
  for workload in rebake light table scaling samples; do measure_bakes $workload; done
  row "rebakes a second, 749 polygons, 3 receivers, 8 samples, 200,000 texels [2]" - \
    "$(calc "1 / $(baked rebake 2 rebake)")" 400 1500 least "%.0f"
  time_row "6,142 polygons, 3 receivers, 32 samples on 2 lights, 200,000 texels [5.5 s]" light \
    "fine light" 30 8
  time_row "25 receivers of such a room, 7 x 7, 3 x 3, 2 x 2 samples [13 s]" table table 60 15
  row "time against scene size, all receive: exponent [2, hoped 1.3]" "$(baked scaling 1 exponent)" \
    "$(baked scaling 2 exponent)" 1.3 1.1 most "%.2f"
  sample_rows
  floor_rows
  cycles_rows
  kitchen_rows
  bake_details >>"$details"
}
