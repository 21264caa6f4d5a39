# Table of the gauges about the island: assets/validation/island/gauges.csv (mm), then gauges.csv of a run. Arrival: the first rise above half of
# the measured crest. A gauge without water counts as still water.
BEGIN { FS = "," }
/^#/ { next }
FILENAME != file { file = FILENAME; files++; if (files == 1) for (k = 2; k <= NF; k++) { sub(/_mm$/, "", $k); name[k] = $k; count = k } next }
files == 1 {
    for (k = 2; k <= count; k++) {
        time[NR] = $1; rise[NR, k] = $k / 1000; rows = NR
        if ($1 <= 12 && (!(k in crest) || $k / 1000 > crest[k])) { crest[k] = $k / 1000; crest_time[k] = $1 }
    }
}
files == 2 {
    if (!settled++) for (k = 2; k <= count; k++) {
        for (i = 1; i <= rows; i++) if (time[i] != "" && rise[i, k] > crest[k] / 2) { arrival[k] = time[i]; break }
    }
    for (k = 2; k <= count; k++) if (name[k] == $2 && $3 != "") {
        if (!(k in found) || $3 > found[k]) { found[k] = $3; found_time[k] = $1 }
        if (!(k in reached) && $3 > crest[k] / 2) reached[k] = $1
    }
}
END {
    print "Measured → this run.\n\n| gauge | highest water above the still level, m | at, s | first rise above half of the measured crest, s |\n|---|---|---|---|"
    for (k = 2; k <= count; k++)
        printf "| %s | %.3f → %s | %.2f → %s | %.2f → %s |\n", name[k], crest[k], k in found ? sprintf("%.3f", found[k]) : "dry", crest_time[k],
               k in found ? sprintf("%.2f", found_time[k]) : "–", arrival[k], k in reached ? sprintf("%.2f", reached[k]) : "–"
}
