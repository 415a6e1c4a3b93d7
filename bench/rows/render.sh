# Whole pictures: the render phase of parker over that of hard, one sample a pixel.

# render_seconds FIGURE METHOD THREADS
render_seconds() {
  "$bin/penumbra" render "scenes/$1.json" -o "$work/picture.png" --quiet --spp 1 \
    --size "${picture}x$picture" --shadows "$2" --threads "$3" --stats "$work/stats.json"
  json_number "$work/stats.json" render
}

# render_ratio FIGURE THREADS
render_ratio() {
  render_seconds "$1" hard "$2" >/dev/null
  render_seconds "$1" parker "$2" >/dev/null
  round=0
  while [ "$round" -lt "$repeats" ]; do
    calc "1 / $(render_seconds "$1" hard "$2") * $(render_seconds "$1" parker "$2")"
    say ""
    round=$((round + 1))
  done | median
}

render_rows() {
  for figure in figure4 figure5; do
    note "pictures of $figure"
    row "render phase, parker / hard, $figure" "$(render_ratio $figure 1)" \
      "$(render_ratio $figure 2)" 1.4 1.15 most
  done
}
