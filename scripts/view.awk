# The view stage of a camera that looks down -z with y up: it subtracts the eye. Give the eye with -v eye='X Y Z'.
BEGIN   { split(eye, e) }
NF == 3 { printf "%.7f %.7f %.7f\n", $1 - e[1], $2 - e[2], $3 - e[3] }
NF != 3 { print }
