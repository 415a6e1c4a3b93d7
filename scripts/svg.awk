# Primitives for scripts/diagrams: open_svg names the file, the rest draw into it.
function open_svg(path, width, height) {
  file = path
  printf "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\">\n", width, height, width, height > file
  print "<style>" > file
  print "text { font: 15px sans-serif; fill: #222 } .symbol { font: italic 19px serif }" > file
  print ".middle { text-anchor: middle } .end { text-anchor: end } .on_dark { fill: #fff }" > file
  print ".solid, .solid_area { fill: #45525e } .soft { fill: #45525e; opacity: .08 }" > file
  print ".soft6, .outer { fill: #45525e; opacity: .22 } .outline { fill: none; stroke: #45525e; stroke-dasharray: 4 3 }" > file
  print ".soft_line { fill: #c9cdd1; stroke: #c9cdd1; stroke-linejoin: round }" > file
  print ".light, .lamp { fill: #ffc935; stroke: #b98500 } .dot { fill: #222 } .white_dot { fill: #fff }" > file
  print ".ray { stroke: #d08900 } .dashed { stroke: #d08900; stroke-dasharray: 6 4 } .leaking { stroke: #d8302a }" > file
  print ".edge { stroke: #222; stroke-width: 2 } .thin, .measure { stroke: #222 } .white { stroke: #fff }" > file
  print ".umbra { fill: #333 } .leak { fill: #f6b0ac } .fade_right { fill: url(#right) } .fade_left { fill: url(#left) }" > file
  print "</style>" > file
  print "<defs>" > file
  print "<linearGradient id=\"right\"><stop offset=\"0\" stop-color=\"#333\"/><stop offset=\".25\" stop-color=\"#333\" stop-opacity=\".84\"/><stop offset=\".5\" stop-color=\"#333\" stop-opacity=\".5\"/><stop offset=\".75\" stop-color=\"#333\" stop-opacity=\".16\"/><stop offset=\"1\" stop-color=\"#333\" stop-opacity=\"0\"/></linearGradient>" > file
  print "<linearGradient id=\"left\" href=\"#right\" gradientTransform=\"rotate(180 .5 .5)\"/>" > file
  print "<marker id=\"tip\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"7\" markerHeight=\"7\" orient=\"auto-start-reverse\"><path d=\"M0 1 8 4 0 7z\" fill=\"#222\"/></marker>" > file
  print "</defs>" > file
  printf "<rect width=\"%d\" height=\"%d\" fill=\"#fff\"/>\n", width, height > file
}
function close_svg() { print "</svg>" > file; close(file) }
function line(x0, y0, x1, y1, class) {
  printf "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" class=\"%s\"/>\n", x0, y0, x1, y1, class > file
}
function measure(x0, y0, x1, y1) {
  printf "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" class=\"measure\" marker-start=\"url(#tip)\" marker-end=\"url(#tip)\"/>\n", x0, y0, x1, y1 > file
}
function disc(x, y, r, class) {
  printf "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" class=\"%s\"/>\n", x, y, r, class > file
}
function ring(x, y, r) { disc(x, y, r, "outline") }
function box(x, y, width, height, class) {
  printf "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" class=\"%s\"/>\n", x, y, width, height, class > file
}
function band(x, y, width, height, class) { box(x, y, width, height, class) }
function rounded(points, width, class) {
  printf "<polygon points=\"%s\" stroke-width=\"%s\" class=\"%s\"/>\n", points, width, class > file
}
function text(x, y, words, class) {
  printf "<text x=\"%.1f\" y=\"%.1f\" class=\"%s\">%s</text>\n", x, y, class, words > file
}
