# Table of the force on the column: assets/validation/column/force.csv (set a), then forces.csv of a run. Both from their arrival, when the
# force first passes 2 N after 0.05 s: 20 ms means.
function value_at(who, t,    i, sum, n) { # mean over 20 ms about t
    for (i = 1; i <= rows[who]; i++) if (at[who, i] > t - 0.01001 && at[who, i] <= t + 0.01) { sum += load[who, i]; n++ }
    return n ? sum / n : ""
}
function judge(who,    i, t, v, start, n) {
    start = ""
    for (t = 0.05; t < 2; t += 0.005) {
        v = value_at(who, t)
        if (v == "") continue
        if (start == "" && v > 2) start = t
        if (start == "") continue
        if (v > peak[who] + 0) { peak[who] = v; peak_time[who] = t - start }
        if (t >= start + 0.15 && t <= start + 0.35) { sum[who] += v; n++ }
        if (t >= start && t <= start + 0.95) impulse[who] += v * 0.005
        if (t > start + 0.8 && (least[who] == "" || v < least[who])) { least[who] = v; least_time[who] = t - start }
    }
    level[who] = sum[who] / n
    return start
}
BEGIN { FS = "," }
/^#/ { next }
FILENAME != file { file = FILENAME; files++; next }
files == 1 && $2 == "a" { rows["lab"]++; at["lab", rows["lab"]] = $1; load["lab", rows["lab"]] = $3 }
files == 2 && $2 == "column" { rows["run"]++; at["run", rows["run"]] = $1 - 0.0025; load["run", rows["run"]] = $3 }
END {
    judge("lab"); judge("run")
    print "Force on the column, 20 ms means, times from the arrival (2 N).\n\n| quantity | measured | this run |\n|---|---|---|"
    printf "| peak, N | %.1f | %.1f |\n| peak, s after the arrival | %.2f | %.2f |\n", peak["lab"], peak["run"], peak_time["lab"], peak_time["run"]
    printf "| mean from 0.15 to 0.35 s, N | %.1f | %.1f |\n", level["lab"], level["run"]
    printf "| impulse until 0.95 s, N s | %.1f | %.1f |\n", impulse["lab"], impulse["run"]
    printf "| least force after 0.8 s, N | %.1f | %.1f |\n| least force, s after the arrival | %.2f | %.2f |\n", least["lab"], least["run"],
           least_time["lab"], least_time["run"]
}
