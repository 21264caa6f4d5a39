# Thins an ESRI ASCII grid with heights in m to every second node, in whole mm, carries its first column on to the left and cuts it on
# the right:
#   awk -v left=5 -v last=361 -f thin.awk bathymetry.asc > terrain.asc
# left: new columns before the first; last: the old grid's last column that is kept, counted from 1. A body of shape grid reads the
# result with scale 0.001.
function millimetres(height) { return sprintf("%d", 1000 * height + (height < 0 ? -0.5 : 0.5)) }
$1 ~ /^[A-Za-z]/ { head[tolower($1)] = $2; next }
!rows++ {
    cell = 2000 * head["cellsize"]
    printf "ncols %d\nnrows %d\n", left + int((last + 1) / 2), int((head["nrows"] + 1) / 2)
    printf "xllcenter %d\nyllcenter %d\ncellsize %d\n", 1000 * head["xllcenter"] - left * cell, 1000 * head["yllcenter"], cell
}
rows % 2 == 1 {
    line = millimetres($1)
    for (k = 1; k < left; k++) line = line " " millimetres($1)
    for (k = 1; k <= last; k += 2) line = line " " millimetres($k)
    print line
}
