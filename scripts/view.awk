# The view stage of a camera that looks down -z with y up: it subtracts the eye. Give the eye with -v eye='X Y Z'.
BEGIN             { split(eye, e) }
/^(eye|look|up) / { next }
/^[-0-9]/         { for (i = 1; i <= 3; i++) $i = sprintf("%.7f", $i - e[i]) }
                  { print }
