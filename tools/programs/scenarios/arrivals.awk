# Of gauges.csv: for each gauge that was dry at first, the row "gauge,NAME,arrival,s,SCENE,1,VALUE": the first time with water.
# -v scene=NAME. A gauge that stays dry has no value.
FNR == 1 { next }
!($2 in met) { met[$2] = ++count; name[count] = $2; dry[$2] = $4 == "" }
dry[$2] && $4 != "" && !($2 in time) { time[$2] = $1 }
END {
    for (i = 1; i <= count; i++) if (dry[name[i]]) print "gauge," name[i] ",arrival,s," scene ",1," time[name[i]]
}
