
#include "bolt.h"
#include <stdio.h>
int main(void) {
  bolt_state state;
  double at[3];
  FILE *path = fopen("path.txt", "r"), *out = fopen("forces.txt", "w");
  bolt_start(&state, 0, 0, 0);
  while (fscanf(path, "%lf %lf %lf", at, at + 1, at + 2) == 3) {
    bolt_forces tried = bolt_step(&state, NULL, at[0], at[1], at[2]);
    bolt_forces taken = bolt_step(&state, &state, at[0], at[1], at[2]);
    int i, j;
    if (tried.tangential[0] != taken.tangential[0]) return 1;
    fprintf(out, "%.17g %.17g %.17g", taken.normal, taken.tangential[0], taken.tangential[1]);
    for (i = 0; i < 3; ++i)
      for (j = 0; j < 3; ++j) fprintf(out, " %.17g", taken.stiffness[i][j]);
    fprintf(out, "\n");
  }
  return fclose(out);
}
