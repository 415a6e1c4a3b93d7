# A model of many triangles over a floor: queries, memory, loading.

# stage FILE.ply BOUNDS_OF.ply: a scene with the model on a floor, seen from the front, under a
# sphere light whose radius is 0.05 of the model's width.
stage() {
  "$bin/penumbra" info "$2" | awk -F '[(),]+ *' -v file="$(basename "$1")" '
    $1 ~ /^bounds/ {
      w = $6 - $2; x = ($6 + $2) / 2; y = ($7 + $3) / 2; z = ($8 + $4) / 2
      printf "{\"camera\": {\"position\": [%g, %g, %g], \"look_at\": [%g, %g, %g]," \
        " \"vertical_fov_deg\": 40},\n", x - 0.4 * w, y + 0.9 * w, z + 1.9 * w, x, y, z
      printf " \"materials\": {\"grey\": {\"diffuse\": [0.7, 0.7, 0.7]}},\n \"objects\": [\n"
      printf "  {\"type\": \"mesh\", \"file\": \"%s\", \"material\": \"grey\"},\n", file
      printf "  {\"type\": \"quad\", \"corner\": [%g, %g, %g], \"edge_u\": [%g, 0, 0]," \
        " \"edge_v\": [0, 0, %g], \"material\": \"grey\"}],\n", x - 2 * w, $3, z + 2 * w, 4 * w, -4 * w
      printf " \"lights\": [{\"type\": \"sphere\", \"position\": [%g, %g, %g], \"radius\": %g," \
        " \"radiance\": [20, 20, 20]}]}\n", x + 0.7 * w, y + 1.2 * w, z + 0.55 * w, 0.05 * w
    }'
}

# get_small_model: small.ply in the work folder.
get_small_model() {
  if [ -n "$dragon" ]; then
    model="the dragon"
    cp "$dragon_small" "$work/small.ply"
  else
    model="a rough torus knot"
    "$bin/make_knot" 11102 "$work/small.ply"
  fi
}

# get_models: large.ply and small.ply in the work folder.
get_models() {
  get_small_model
  if [ -n "$dragon" ]; then
    case $dragon in
      *.gz) gzip -dc "$dragon" >"$work/large.ply" ;;
      *) cp "$dragon" "$work/large.ply" ;;
    esac
  else
    "$bin/make_knot" 871414 "$work/large.ply"
  fi
}

# load_rows: time and memory per triangle.
load_rows() {
  for threads in 1 2; do
    "$bin/bench_load" --repeats "$repeats" --threads $threads "$work/large.ply" \
      >"$work/load-$threads.tsv"
  done
  one=$work/load-1.tsv two=$work/load-2.tsv
  row "memory beyond Embree's own, bytes a triangle, $model" "$(named "$one" cone_tree_bytes)" - \
    100 64 most "%.0f"
  row "load the text of $model / only convert its numbers, one thread" \
    "$(named "$one" load/read_numbers)" "$(named "$two" load/read_numbers)" - - most
  row "load the text of $model / only look at its bytes, one thread" \
    "$(named "$one" load/read_bytes)" "$(named "$two" load/read_bytes)" - - most
}

# load_details: where the time goes.
load_details() {
  say ""
  say "Loading $(named "$one" triangles) triangles, in seconds; a triangle takes" \
    "$(named "$one" mesh_bytes) bytes of mesh, which Embree shares, $(named "$one" embree_bytes)" \
    "of Embree's tree and $(named "$one" cone_tree_bytes) of ours."
  say ""
  say "| threads | bytes | numbers (one thread) | whole load | Embree's tree | ours |"
  say "|---|---|---|---|---|---|"
  for threads in 1 2; do
    file=$work/load-$threads.tsv
    say "| $threads | $(named "$file" read_bytes) | $(named "$file" read_numbers) |" \
      "$(named "$file" load) | $(named "$file" build_embree) | $(named "$file" build_cone_tree) |"
  done
}

dragon_rows() {
  note "the large model"
  get_models
  stage "$work/large.ply" "$work/large.ply" >"$work/large.json"
  stage "$work/small.ply" "$work/large.ply" >"$work/small.json"
  measure_queries large "$work/large.json" 1 3 6 --against "$work/small.json"
  [ -n "$dragon" ] || printf '\nNo dragon was given: a torus knot of as many triangles stood in.\n' >>"$details"
  shown="points a second, parker / 64 rays of bare Embree, $model"
  query_row "$shown, light radius 0.05" large parker/64_rays 1 8 30 least
  query_row "$shown, light radius 0.15" large parker/64_rays 2 4 20 least
  query_row "$shown, light radius 0.3" large parker/64_rays 3 2 10 least
  query_row "parker's time, 871k / 11k triangles, light radius 0.05" large against_time 1 3 1.5 most
  overhead_rows large "$model"
  detail_lines large "$model"
  load_rows
  query_details >>"$details"
  load_details >>"$details"
}
