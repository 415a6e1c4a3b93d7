# Shadow queries at points, against bare Embree.

# measure_queries NAME SCENE [arguments…]: NAME-1.tsv and NAME-2.tsv, by threads.
measure_queries() {
  name=$1 scene=$2
  shift 2
  for threads in 1 2; do
    note "queries of $name, threads: $threads"
    "$bin/bench_shadows" --size "$query_size" --repeats "$repeats" --threads $threads "$scene" \
      "$@" >"$work/$name-$threads.tsv"
  done
}

# query_row WHAT NAME COLUMN ROW MUST AIM most|least
query_row() {
  row "$1" "$(column "$work/$2-1.tsv" "$3" "$4")" "$(column "$work/$2-2.tsv" "$3" "$4")" \
    "$5" "$6" "$7"
}

# overhead_rows NAME SHOWN: our own code against Embree's alone.
overhead_rows() {
  share=$(calc "100 * $(column "$work/$1-1.tsv" share_with_rays 1)")
  query_row "hard / bare Embree, same rays, $2" "$1" hard/bare_time 1 1.1 1.0 most
  query_row "the same, / flat Embree" "$1" hard/flat_time 1 - - most
  query_row "area / bare Embree, same rays, $2" "$1" same_rays/bare_time 1 1.1 1.0 most
  query_row "the same, / flat Embree" "$1" same_rays/flat_time 1 - - most
  query_row "area as it is (it traces rays for $share % of the points) / bare Embree on all" "$1" \
    area/bare_time 1 - - most
}

# detail_lines NAME SHOWN: points a second.
detail_lines() {
  for threads in 1 2; do
    awk -F '\t' -v shown="$2" -v threads=$threads '
      NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
      function cell(name) { return " | " $at[name] }
      {
        print "| " shown cell("radius") " | " threads cell("points") cell("parker_M/s") \
          cell("exact_M/s") cell("hard_M/s") cell("bare_hard_M/s") cell("bare_64_M/s") " |"
      }' "$work/$1-$threads.tsv"
  done >>"$work/queries.md"
}

query_rows() {
  for figure in figure4 figure5; do
    measure_queries $figure "scenes/$figure.json"
    query_row "points a second, parker / 64 rays of bare Embree, $figure" $figure \
      parker/64_rays 1 15 40 least
    detail_lines $figure $figure
  done
  for figure in figure4 figure5; do overhead_rows $figure $figure; done
}

# query_details: the section under the table.
query_details() {
  say ""
  say "Million points a second. Exact is \`parker --tolerance 0\`. Bare Embree traces rays that are" \
    "ready made, one by one, in packets of 8 and of 16, in the scene that the methods use (robust" \
    "edges, filters for holes); then the same in a flat scene with default flags. The ratios above" \
    "are to the fastest way; 64 rays are those to 64 points of the light, in the flat scene."
  say ""
  say "| scene | light radius | threads | points | parker | exact | hard | bare hard | bare 64 rays |"
  say "|---|---|---|---|---|---|---|---|---|"
  cat "$work/queries.md"
}
