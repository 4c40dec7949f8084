#define HALF 2
double macro_fourth() { return HALF; }
