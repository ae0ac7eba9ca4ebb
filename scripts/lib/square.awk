# Reads a config of zbuf. If a square that faces the camera is drawn more than 1 % off square, prints by how much, and what
# mends it. Give the projection, a header line of a stage text, with -v projection='perspective 60 1 1 10'.

function tangent(x) { return sin(x) / cos(x) }
function is_close(a, b) { return a <= 1.01 * b && b <= 1.01 * a }

{ sub(/#.*/, ""); gsub(/\r/, ""); for (i = 1; i <= NF; ++i) config[++count] = $i }

END {
  split(projection, p)
  if (count != 2 && count != 6) exit
  # Pixels per unit of x in NDC, over those of y: the width over the height of the window that has square pixels.
  square = count == 2 ? config[1] / config[2] : config[1] * config[4] / (config[2] * config[3])
  if (p[1] == "perspective") {
    half_degree = atan2(0, -1) / 360
    window = p[6] == "ratio" ? p[3] : tangent(p[2] * p[3] * half_degree) / tangent(p[2] * half_degree)
  } else {
    window = (p[3] - p[2]) / (p[5] - p[4])
    if (window < 0) window = -window  # mirrored
  }
  if (is_close(window, square)) exit
  drawn = sprintf("a square is drawn %.3g times as wide as high: ", square / window)
  if (p[1] != "perspective") print drawn sprintf("let (right - left) / (top - bottom) be %.6g in the scene's fourth line", square)
  else if (p[6] != "ratio" && is_close(p[3], square)) print drawn "end the scene's fourth line in ratio"
  else if (p[6] == "ratio" || is_close(square, 1)) print drawn sprintf("let the aspect be %.6g in the scene's fourth line", square)
  else print drawn sprintf("let the aspect be %.6g in the scene's fourth line, and end that line in ratio", square)
}
