set terminal pngcairo noenhanced size 900,360 font 'Sans,10'
set output '/work/main/docs/results/bench/scaling.png'
set grid lt 1 lw 0.5 lc rgb '#dddddd'
set border 3 lc rgb '#555555'
set tics nomirror
set key outside right top Left reverse
set lmargin 12
set rmargin 30
set multiplot layout 1,1
set title 'Whole steps of ten iterations'
set xlabel 'log10 of the number of particles'
set ylabel 'ns per particle and step'
unset logscale
set format
set xrange [*:*]
set yrange [0:*]
plot 'scaling.dat' index 0 using 1:2 with lines lw 1.5 lc rgb '#0072b2' title '1 thread', 'scaling.dat' index 1 using 1:2 with lines lw 1.5 lc rgb '#d55e00' title '2 threads'
unset multiplot
