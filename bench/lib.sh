# Shared by bench/run and its rows (POSIX shell, sourced after scripts/lib.sh).

# note TEXT…: progress, for who waits.
note() { printf 'bench/run: %s\n' "$*" >&2; }

# calc EXPRESSION: by awk.
calc() { awk "BEGIN { printf \"%.6g\", $1 }"; }

# median: of the numbers on standard input, one a line.
median() { sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }

# json_number FILE KEY: the first number of that key in a file of --stats.
json_number() {
  awk -v key="\"$2\"" '$1 == key && $2 == ":" { gsub(/,/, "", $3); print $3; exit }' "$1"
}

# named FILE NAME: the value on a line "NAME<tab>VALUE".
named() { awk -F '\t' -v name="$2" '$1 == name { print $2; exit }' "$1"; }

# column FILE NAME ROW: a cell of tab-separated columns under a header; rows count from 1.
column() {
  awk -F '\t' -v name="$2" -v row="$3" '
    NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) at = i }
    NR == row + 1 { print $at; exit }' "$1"
}

# wall_seconds COMMAND…: how long it takes as a whole; its output goes to the log.
wall_seconds() {
  wall_start=$(date +%s.%N)
  "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; die "this failed: $*"; }
  calc "$(date +%s.%N) - $wall_start"
}

# row WHAT ONE TWO MUST AIM most|least [FORMAT]: a line of the table. ONE and TWO are measured with
# one and two threads ('-' if that is not asked); most: they may be at most MUST, least: at least.
row() {
  awk -v what="$1" -v one="$2" -v two="$3" -v must="$4" -v aim="$5" -v sense="$6" \
    -v form="${7:-%.2f x}" '
    function shown(x) { return x == "-" ? "" : sprintf(form, x) }
    function short_of(limit, x) {
      if (x == "-") return 0
      return sense == "most" ? x + 0 > limit + 0 : x + 0 < limit + 0
    }
    function missed(limit) { return short_of(limit, one) || short_of(limit, two) }
    BEGIN {
      verdict = must == "-" ? "" : missed(must) ? "**missed**" : missed(aim) ? "must" : "aim"
      printf "| %s | %s | %s | %s | %s | %s |\n", what, shown(one), shown(two), shown(must),
        shown(aim), verdict
    }' >>"$table"
}

# describe_machine: what was measured on what.
describe_machine() {
  cpu=$(awk -F ': *' '/^model name/ { print $2; exit }' /proc/cpuinfo)
  compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' build/release/CMakeCache.txt)
  embree=$(dpkg-query -W -f='${Package} ${Version}, ' 'libembree[34]*' 2>/dev/null)
  say "Measured $(date -u +%Y-%m-%d) by \`bench/run\` on ${cpu:-an unknown processor}," \
    "$(processors) cores; load average at the end $(cut -d ' ' -f 1 /proc/loadavg);" \
    "$("$compiler" --version | head -n 1); ${embree}commit $(git describe --always --dirty)."
}

# put_into PAGE FILE MARK: replaces what is between the page's markers of that name.
put_into() {
  begin="<!-- $3: begin -->" end="<!-- $3: end -->"
  if [ ! -e "$1" ]; then
    printf '# Benchmarks\n\nMade by `bench/run --write`, which says how.\n\n%s\n%s\n' "$begin" \
      "$end" >"$1"
  fi
  for marker in "$begin" "$end"; do
    grep -qxF -e "$marker" "$1" || die "$1 has lost its marker $marker"
  done
  awk -v begin="$begin" -v end="$end" -v file="$2" '
    $0 == end { inside = 0 }
    !inside { print }
    $0 == begin { inside = 1; while ((getline line < file) > 0) print line }' "$1" >"$1.new"
  mv "$1.new" "$1"
}
