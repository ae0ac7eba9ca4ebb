# The view stage of a camera that looks down -z with y up: it subtracts the eye of the header, or of -v eye='X Y Z'.
/^eye /           { eye = $2 " " $3 " " $4 }
/^(eye|look|up) / { next }
/^[-0-9]/         { split(eye, e); for (i = 1; i <= 3; i++) $i = sprintf("%.7f", $i - e[i]) }
                  { print }
