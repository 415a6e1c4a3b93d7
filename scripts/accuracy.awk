# Tables for scripts/accuracy: FOLDER/NAME.table each, from its file of results.

# Adds one error to the sums of a group of points, twice: under "all" and, for points that see part
# of the light, under "penumbra".
function add(name, group, truth, found,   kind) {
  for (kind = 1; kind <= 2; ++kind) {
    if (kind == 2 && (truth <= 0.002 || truth >= 0.998)) return
    n[name, group, kind]++
    squares[name, group, kind] += (found - truth) ^ 2
    errors[name, group, kind] += found - truth
    dark[name, group, kind] += found == 0
    if (abs(found - truth) > worst[name, group, kind])
      worst[name, group, kind] = abs(found - truth)
  }
}

function abs(x) { return x < 0 ? -x : x }
function rmse(name, group, kind) { return sqrt(squares[name, group, kind] / n[name, group, kind]) }
function bias(name, group, kind) { return errors[name, group, kind] / n[name, group, kind] }
function three(x) { return sprintf("%.3f", x) }
function signed(x) { x = sprintf("%+.3f", x); sub(/-/, "−", x); return x }

$1 == "light" {
  type[$2, $3] = $4
  if (!(($2) in seen)) { seen[$2] = 1; scenes[++scene_count] = $2 }
  if (!(($4) in seen)) { seen[$4] = 1; types[++type_count] = $4 }
}
$1 == "found" {
  add($2, $3, $5, $6)
  add($2, type[$3, $4], $5, $6)
  add($2, "all scenes", $5, $6)
  value[$2, ++count[$2]] = $6
}
$1 == "cost" { points[$2] += $4; rays[$2] += $5; leaves[$2] += $6; steps[$2] += $7 }

function open_table(name, header,   i, rule, columns) {
  out = folder "/" name ".table"
  columns = split(header, cells, "|")
  rule = "|---|"
  for (i = 3; i < columns; ++i) rule = rule "---:|"
  print header > out
  print rule > out
}
function row(text) { print text > out }

# One row a group of points, one column a method.
function by_group(table, head, columns, names, groups, group_count, kind, what,   i, k, list, m, text) {
  open_table(table, "| " head " | " columns " |")
  m = split(names, list, " ")
  for (i = 1; i <= group_count; ++i) {
    text = "| " groups[i] " |"
    for (k = 1; k <= m; ++k)
      text = text " " (what == "rmse" ? three(rmse(list[k], groups[i], kind)) \
                                      : signed(bias(list[k], groups[i], kind))) " |"
    row(text)
  }
  close(out)
}

# One method in all scenes.
function one_method(table, name,   i) {
  open_table(table, "| scene | RMSE in penumbrae | RMSE, all points | bias, all points |" \
    " penumbra points called dark |")
  for (i = 1; i <= scene_count; ++i)
    row("| " scenes[i] " | " three(rmse(name, scenes[i], 2)) " | " three(rmse(name, scenes[i], 1)) \
      " | " signed(bias(name, scenes[i], 1)) " | " \
      sprintf("%.0f %%", 100 * dark[name, scenes[i], 2] / n[name, scenes[i], 2]) " |")
  close(out)
}

function per_point(total, name) { return sprintf("%.1f", total[name] / points[name]) }

# One row a setting, all scenes together.
function settings(table, head, prefix, list,   i, m, s, name) {
  open_table(table, "| " head " | RMSE in penumbrae | RMSE, all points | largest error |" \
    " rays a point |")
  m = split(list, s, " ")
  for (i = 1; i <= m; ++i) {
    name = prefix s[i]
    row("| " s[i] " | " three(rmse(name, "all scenes", 2)) " | " three(rmse(name, "all scenes", 1)) \
      " | " three(worst[name, "all scenes", 1]) " | " per_point(rays, name) " |")
  }
  close(out)
}

function samples(table, prefix, list,   i, m, s, name) {
  open_table(table, "| `--light-samples` | RMSE in penumbrae | RMSE, all points | largest error |")
  m = split(list, s, " ")
  for (i = 1; i <= m; ++i) {
    name = prefix s[i]
    row("| " s[i] " | " three(rmse(name, "all scenes", 2)) " | " three(rmse(name, "all scenes", 1)) \
      " | " three(worst[name, "all scenes", 1]) " |")
  }
  close(out)
}

function profile_row(label, name) {
  row("| " label " | " three(rmse(name, "all scenes", 2)) " | " three(rmse(name, "all scenes", 1)) \
    " | " signed(bias(name, "all scenes", 1)) " |")
}
function profiles() {
  open_table("parker-profiles", "| profile | RMSE in penumbrae | RMSE, all points | bias |")
  profile_row("cubic", "tolerance-0")
  profile_row("sine", "sine")
  profile_row("linear", "linear")
  close(out)
}

function tolerance_row(label, name,   i, change, largest, sum) {
  for (i = 1; i <= count[name]; ++i) {
    change = abs(value[name, i] - value["tolerance-0", i])
    sum += change
    if (change > largest) largest = change
  }
  row("| " label " | " three(largest) " | " sprintf("%.4f", sum / count[name]) " | " \
    per_point(leaves, name) " |")
}
function tolerances() {
  open_table("parker-tolerance", \
    "| `--tolerance` | largest change | mean change | leaves of the tree a point |")
  tolerance_row("0", "tolerance-0")
  tolerance_row("0.005", "tolerance-0.005")
  tolerance_row("0.02 (default)", "parker")
  tolerance_row("0.05", "tolerance-0.05")
  tolerance_row("0.1", "tolerance-0.1")
  close(out)
}

# The three profiles of the options against the law of a disk and a straight edge.
function arcsine(x) { return atan2(x, sqrt(1 - x * x)) }
function law(tau,   x) { x = 2 * tau - 1; return 0.5 + (x * sqrt(1 - x * x) + arcsine(x)) / pi }
function cubic(tau) { return 3 * tau ^ 2 - 2 * tau ^ 3 }
function sine(tau) { return (1 + sin(pi * tau - pi / 2)) / 2 }
function law_row(label, largest, squared) {
  row("| " label " | " three(largest) " | " three(sqrt(squared / 1001)) " |")
}
function laws(   i, tau, d, most, sum) {
  for (i = 0; i <= 1000; ++i) {
    tau = i / 1000
    d[1] = abs(cubic(tau) - law(tau)); d[2] = abs(sine(tau) - law(tau)); d[3] = abs(tau - law(tau))
    for (k = 1; k <= 3; ++k) { sum[k] += d[k] ^ 2; if (d[k] > most[k]) most[k] = d[k] }
  }
  open_table("profile-laws", "| profile | largest difference | root mean square |")
  law_row("cubic, 3τ² − 2τ³", most[1], sum[1])
  law_row("sine, (1 + sin(πτ − π/2)) / 2", most[2], sum[2])
  law_row("linear, τ", most[3], sum[3])
  close(out)
}

function method_row(name, what, cost, label) {
  row("| [`" label "`](docs/methods/" label ".md) | " what " | " cost " | " \
    three(rmse(name, "all scenes", 2)) " | " three(rmse(name, "all scenes", 1)) " |")
}
function methods() {
  open_table("methods", "| method | what it does | cost | error in penumbrae | error, all points |")
  row("| `none` | no shadows | nothing | " three(rmse("none", "all scenes", 2)) " | " \
    three(rmse("none", "all scenes", 1)) " |")
  method_row("hard", "one ray to the light's centre: seen or not", "1 ray", "hard")
  method_row("parker", "the shadow of a soft-edged object under a point light: smooth, no noise", \
    "1 cone", "parker")
  method_row("heckbert-herf", "the average of hard shadow images from points of the light, as" \
    " textures", "1 texel of each image", "heckbert-herf")
  method_row("sdf-classic", "marches the distance field; the least h / (w t) on the way", \
    per_point(steps, "sdf-classic") " steps", "sdf-classic")
  method_row("sdf-improved", "the same between the samples too", \
    per_point(steps, "sdf-improved") " steps", "sdf-improved")
  method_row("sdf-inner", "the same through solids, for the inner half of the penumbra", \
    per_point(steps, "sdf-inner") " steps", "sdf-inner")
  method_row("area-64", "the mean over 64 points of the light: the reference, with N points as" \
    " exact as you like", per_point(rays, "area-64") " rays", "area")
  row("| `area --error 0.01` | points only where the light is cut | " per_point(rays, "error-0.01") \
    " rays | " three(rmse("error-0.01", "all scenes", 2)) " | " \
    three(rmse("error-0.01", "all scenes", 1)) " |")
  close(out)
}

END {
  pi = atan2(0, -1)
  scenes[scene_count + 1] = "all scenes"
  columns = "`none` | `hard` | `parker` | `heckbert-herf` | `sdf-classic` | `sdf-improved` | `sdf-inner` | `area`, 16 points | 64 | 256 | 4096 | `--error 0.01`"
  list = "none hard parker heckbert-herf sdf-classic sdf-improved sdf-inner area-16 area-64 area-256 area-4096 error-0.01"
  by_group("rmse-penumbra", "scene", columns, list, scenes, scene_count + 1, 2, "rmse")
  by_group("rmse-all", "scene", columns, list, scenes, scene_count + 1, 1, "rmse")
  by_group("bias", "scene", columns, list, scenes, scene_count + 1, 1, "bias")
  by_group("by-light", "light", columns, list, types, type_count, 2, "rmse")
  by_group("parker-composites", "scene", "`min` | `multiply` | `add`", \
    "tolerance-0 multiply add", scenes, scene_count + 1, 2, "rmse")
  ++scene_count
  one_method("hard", "hard")
  one_method("parker", "parker")
  one_method("heckbert-herf", "heckbert-herf")
  samples("heckbert-herf-points", "herf-", "4 16 64 256 1024")
  one_method("sdf-classic", "sdf-classic")
  one_method("sdf-classic-blog", "blog")
  one_method("sdf-improved", "sdf-improved")
  one_method("sdf-inner", "sdf-inner")
  one_method("sdf-inner-abs", "abs")
  settings("area-points", "`--light-samples`", "area-", "4 16 64 256 1024 4096")
  settings("area-adaptive", "`--error`", "error-", "0.05 0.02 0.01 0.005")
  profiles()
  tolerances()
  laws()
  methods()
}
