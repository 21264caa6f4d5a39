#include "sim/passes/cpu/routes.h"

#include "sim/passes/cpu/edges.h"

void sb_relations_find(const sb_near *near, sb_relations *relations)
{
    for (size_t a = 0; a < near->count; a++) {
        sb_facet_set next = {0}, crooked = {0}, blunt = {0};
        for (size_t b = 0; b < near->count; b++) {
            const float sectors = near->sectors[a][b];
            sb_facet_set_put(&next, b, b == a || (near->meets[a][b] && sectors > SB_SECTORS_LEAST));
            sb_facet_set_put(&crooked, b, sb_facets_crooked(near, a, b));
            sb_facet_set_put(&blunt, b, sectors > SB_SECTORS_LEAST && sectors < 2);
        }
        relations->next[a] = next, relations->crooked[a] = crooked, relations->blunt[a] = blunt;
    }
}

void sb_relations_find_parts(const sb_near *near, sb_relations *relations)
{
    relations->parts = (sb_facet_set){0};
    for (size_t a = 0; a < near->count; a++) {
        sb_facet_set hide = {0}, block = {0};
        for (size_t b = 0; b < near->count; b++) {
            const bool parts = near->facet[b].parts, meets = near->meets[a][b];
            const bool square = sb_facets_square(near, a, b), crooked = sb_facets_crooked(near, a, b);
            sb_facet_set_put(&hide, b, b != a && parts && meets && (square || crooked));
            sb_facet_set_put(&block, b, b != a && !(square && (parts || !meets)) && !(parts && crooked));
        }
        sb_facet_set_put(&relations->parts, a, near->facet[a].parts);
        relations->hide[a] = hide, relations->block[a] = block;
    }
}

bool sb_route_ordered(const sb_near *near, const sb_route *from, size_t a)
{
    bool exchanged = true; /* with all facets from here to the end of the path */
    bool returns = false;
    int between = 0; /* facets since the path was at a last that may have to stay there, and the angle of one of them */
    float sectors = 0;
    for (int k = from->depth; k-- > 0;) {
        const size_t b = (from->path >> (SB_REFLECTION_BITS * k) & SB_REFLECTION_MASK) - 1;
        /* A path that returns to a facet has no share if the one between stands at 72 degrees or more (path_orders.c).
         */
        if (b == a && !returns && (between == 0 || (between == 1 && sectors <= 2.5f))) return false;
        returns |= b == a;
        if (!returns && near->sectors[b][a] > 2) between++, sectors = near->sectors[b][a];
        exchanged &= b == a || sb_facets_square(near, b, a);
        if (exchanged && b <= a) return false;
        exchanged &= b != a;
    }
    return true;
}

bool sb_route_blunt_to(const sb_relations *relations, const sb_route *from, size_t a)
{
    bool blunt = false;
    for (uint32_t path = from->path; path; path >>= SB_REFLECTION_BITS)
        blunt |= sb_facet_set_has(&relations->blunt[a], (path & SB_REFLECTION_MASK) - 1);
    return blunt;
}

/* Whether facet a stands at right angles to all facets of a path. */
static bool square_to_all(const sb_near *near, uint32_t path, size_t a)
{
    bool square = true;
    for (; path; path >>= SB_REFLECTION_BITS) square &= sb_facets_square(near, (path & SB_REFLECTION_MASK) - 1, a);
    return square;
}

void sb_route_append(const sb_near *near, const sb_relations *relations, const sb_route *from, size_t a, sb_route *to)
{
    to->path = from->path | (uint32_t)(a + 1) << (SB_REFLECTION_BITS * from->depth);
    to->depth = from->depth + 1;
    to->last = a;
    to->square = from->square && square_to_all(near, from->path, a);
    to->crooked = from->crooked || sb_route_leans(from, a);
    to->blunt = from->blunt || near->blunt[a];
    for (size_t w = 0; w < SB_FACET_WORDS; w++) {
        to->next.word[w] = from->next.word[w] & relations->next[a].word[w];
        to->leans.word[w] = from->leans.word[w] | relations->crooked[a].word[w];
    }
}

void sb_route_begin(const sb_near *near, const sb_relations *relations, size_t a, sb_route *to)
{
    to->path = (uint32_t)(a + 1);
    to->depth = 1;
    to->last = a;
    to->square = true;
    if (!near->meeting) return;
    to->blunt = near->blunt[a];
    to->next = relations->next[a];
    to->leans = relations->crooked[a];
}
