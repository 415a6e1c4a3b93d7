# The plots of scripts/gallery; input: METHOD X FRACTION along a line across a straight edge.
# Drawn in a frame from (60, 20) to (560, 260): `x0` to `x1` across, 0 to 1 upwards.
function across(x) { return 60 + 500 * (x - x0) / (x1 - x0) }
function upwards(y) { return 260 - 240 * y }

function curve(xs, ys, count, color, dashes,   i) {
  printf "<path fill=\"none\" stroke=\"%s\" stroke-width=\"2.5\" stroke-dasharray=\"%s\" d=\"", color, dashes > file
  for (i = 1; i <= count; ++i) printf "%s%.1f %.1f", (i == 1 ? "M" : " L"), across(xs[i]), upwards(ys[i]) > file
  print "\"/>" > file
}

function legend(line_number, color, dashes, words,   y) {
  y = 20 + 24 * line_number
  printf "<line x1=\"580\" y1=\"%d\" x2=\"612\" y2=\"%d\" stroke=\"%s\" stroke-width=\"2.5\" stroke-dasharray=\"%s\"/>\n", y, y, color, dashes > file
  text(620, y + 5, words, "start")
}

function frame(label, ticks,   i, n, t) {
  line(60, 260, 560, 260, "edge"); line(60, 20, 60, 260, "edge")
  for (i = 0; i <= 4; ++i) text(52, upwards(i / 4) + 5, i / 4, "end")
  n = split(ticks, t, " ")
  for (i = 1; i <= n; ++i) { line(across(t[i]), 260, across(t[i]), 266, "edge"); text(across(t[i]), 284, t[i], "middle") }
  text(310, 310, label, "middle"); text(60, 12, "visible fraction", "start")
}

{ n[$1]++; x[$1, n[$1]] = $2; y[$1, n[$1]] = $3 }

function measured(method, color, dashes,   i, xs, ys) {
  for (i = 1; i <= n[method]; ++i) { xs[i] = x[method, i]; ys[i] = y[method, i] }
  curve(xs, ys, n[method], color, dashes)
}

function arcsine(v) { return atan2(v, sqrt(1 - v * v)) }
function value(profile, tau,   v) {
  v = 2 * tau - 1
  if (profile == "law") return 0.5 + (v * sqrt(1 - v * v) + arcsine(v)) / pi
  if (profile == "cubic") return 3 * tau ^ 2 - 2 * tau ^ 3
  if (profile == "sine") return (1 + sin(pi * tau - pi / 2)) / 2
  return tau
}
function computed(profile, color, dashes,   i, xs, ys) {
  for (i = 0; i <= 100; ++i) { xs[i + 1] = i / 100; ys[i + 1] = value(profile, i / 100) }
  curve(xs, ys, 101, color, dashes)
}

END {
  pi = atan2(0, -1)
  open_svg(folder "/knife-edge.svg", 800, 320)
  x0 = -0.75; x1 = -0.15
  frame("metres across the shadow's edge", "-0.7 -0.6 -0.5 -0.4 -0.3 -0.2")
  measured("area", "#222", "none"); measured("hard", "#d8302a", "7 4"); measured("parker", "#1769c4", "none")
  legend(1, "#222", "none", "area, 4096 points"); legend(2, "#d8302a", "7 4", "hard"); legend(3, "#1769c4", "none", "parker")
  close_svg()
  open_svg(folder "/profiles.svg", 800, 320)
  x0 = 0; x1 = 1
  frame("τ", "0 0.25 0.5 0.75 1")
  computed("law", "#222", "none"); computed("cubic", "#1769c4", "none"); computed("sine", "#2c9143", "7 4"); computed("linear", "#d8302a", "2 4")
  legend(1, "#222", "none", "disk and straight edge"); legend(2, "#1769c4", "none", "cubic (default)"); legend(3, "#2c9143", "7 4", "sine"); legend(4, "#d8302a", "2 4", "linear")
  close_svg()
}
