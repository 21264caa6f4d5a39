# Tables in Markdown of compare.csv: "value of the first scene → value of the other one". A row "gauge,NAME,arrival,s,SCENE,1,VALUE"
# may follow for each gauge that was dry at the start.
function digits(value,    size, places, unit) {
    if (value == "") return "–"
    if (value == 0) return "0"
    size = value < 0 ? -value : value
    if (size >= 1000) { # three digits
        unit = 10 ^ (length(int(size)) - 3)
        return sprintf("%.0f", int(value / unit + (value < 0 ? -0.5 : 0.5)) * unit)
    }
    places = size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3
    return sprintf("%." places "f", value)
}
function arrow(one, other) { return one == other ? one : one " → " other }
function pair(kind, name, quantity, scale,    one, other, dry) {
    dry = quantity == "first_wet" || quantity == "arrival" ? "dry" : "–"
    one = kind SUBSEP name SUBSEP quantity SUBSEP first; other = kind SUBSEP name SUBSEP quantity SUBSEP second
    if (quantity == "arrival" && !(one in mean) && !(other in mean)) return "wet at the start"
    one = !(one in mean) || mean[one] == "" ? dry : digits(mean[one] * scale)
    other = !(other in mean) || mean[other] == "" ? dry : digits(mean[other] * scale)
    return arrow(one, other)
}
function item(kind, name, quantities, scales,    n, k, q, s, line) {
    n = split(quantities, q, " "); split(scales, s, " ")
    line = "| " name
    for (k = 1; k <= n; k++) line = line " | " pair(kind, name, q[k], s[k] == "F" ? force : 1)
    print line " |"
}
function heading(heads,    n, h, k, line, rule) {
    n = split(heads, h, "; "); line = "|"; rule = "|"
    for (k = 1; k <= n; k++) { line = line " " h[k] " |"; rule = rule "---|" }
    print line "\n" rule
}
function table(kind, heads, quantities, scales,    i, begun) {
    for (i = 1; i <= count; i++) {
        if (kinds[i] != kind || (kind == "body" && !loaded[names[i]])) continue
        if (!begun++) heading(heads)
        item(kind, names[i], quantities, scales)
    }
    if (begun) print ""
}
# Mean and extremes over bodies of one group, such as house-2 for house-2-1 to house-2-8; a dry body counts as 0.
function of_group(group, quantity, scale, scene,    i, value, sum, least, greatest, n) {
    for (i = 1; i <= count; i++) {
        if (kinds[i] != "body" || group_of[names[i]] != group) continue
        value = mean["body", names[i], quantity, scene]
        if (value == "" && quantity == "first_wet") continue
        value *= scale; sum += value
        if (!n || value < least) least = value
        if (!n || value > greatest) greatest = value
        n++
    }
    if (!n) return "dry"
    return digits(sum / n) " (" digits(least) "–" digits(greatest) ")"
}
function groups(    i, g, begun) {
    for (i = 1; i <= count; i++) {
        g = group_of[names[i]]
        if (kinds[i] != "body" || g == "" || shown[g]++) continue
        ordered[++group_count] = g
    }
    if (!group_count) return
    asort_names()
    print "Mean over the bodies of a row, and in brackets the least and the greatest; a dry body counts as 0 but for its first wetting.\n"
    heading("row; horizontal force, " prefix "N; impulse, " prefix "N s; overturning moment, " prefix "N m; depth in front, m; first wet, s")
    for (i = 1; i <= group_count; i++) {
        g = ordered[i]
        print "| " g " | " arrow(of_group(g, "force", force, first), of_group(g, "force", force, second)) \
            " | " arrow(of_group(g, "impulse", force, first), of_group(g, "impulse", force, second)) \
            " | " arrow(of_group(g, "moment", force, first), of_group(g, "moment", force, second)) \
            " | " arrow(of_group(g, "depth", 1, first), of_group(g, "depth", 1, second)) \
            " | " arrow(of_group(g, "first_wet", 1, first), of_group(g, "first_wet", 1, second)) " |"
    }
    print ""
}
function asort_names(    i, k, keep) {
    for (i = 2; i <= group_count; i++)
        for (k = i; k > 1 && ordered[k - 1] > ordered[k]; k--) { keep = ordered[k]; ordered[k] = ordered[k - 1]; ordered[k - 1] = keep }
}
$1 == "kind" { next }
{
    if (!($5 in seen)) { seen[$5] = 1; if (first == "") first = $5; else second = $5 }
    if (!(($1, $2) in known)) {
        known[$1, $2] = 1; kinds[++count] = $1; names[count] = $2
        if ($1 == "body" && match($2, /-[0-9]+-[0-9]+$/)) { group_of[$2] = $2; sub(/-[0-9]+$/, "", group_of[$2]) }
    }
    if ($3 == "arrival") arrivals = 1
    mean[$1, $2, $3, $5] = $7
    if ($1 == "body" && $3 == "force" && $7 > 0) { loaded[$2] = 1; if ($7 + 0 > most) most = $7 + 0 }
    if ($1 == "body" && $3 == "force" && $7 > 0) { all[$5]++; if ($12 == "no") bad[$5]++ }
}
END {
    force = most >= 1e7 ? 1e-6 : 1e-3; prefix = most >= 1e7 ? "M" : "k"
    print "`" first "` → `" second "`; one value: it is the same in both.\n"
    groups()
    if (group_count) print "<details><summary>Each body</summary>\n"
    table("body", "body; horizontal force, " prefix "N; impulse, " prefix "N s; overturning moment, " prefix "N m; depth in front, m; first wet, s",
          "force impulse moment depth first_wet", "F F F 1 1")
    if (group_count) print "</details>\n"
    table("gauge", "gauge; highest water, z in m; at, s" (arrivals ? "; first water, s" : ""), "surface surface_time" (arrivals ? " arrival" : ""), "1 1 1")
    table("line", "line; highest run-up, z in m; farthest front, m", "runup front", "1 1")
    table("plane", "plane; greatest net volume, m³; at the end, m³", "volume volume_end", "1 1")
    table("map", "map; flooded ground, m²; greatest depth on it, m", "flooded_area flooded_depth", "1 1")
    printf "Forces that the run itself marks as not reliable: %d of %d in `%s`, %d of %d in `%s`.\n",
           bad[first], all[first], first, bad[second], all[second], second
}
