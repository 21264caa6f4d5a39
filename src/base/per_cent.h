/* Shares as text in per cent. */
#ifndef SB_BASE_PER_CENT_H
#define SB_BASE_PER_CENT_H

/* Writes a share with two digits, 100 % with three, and returns text: "below 0.01 %", "0.35 %", "12 %", "100 %". Less
   than a hundredth of a per cent is rounding, or of no interest. */
const char *sb_per_cent(double share, char text[32]);

#endif
