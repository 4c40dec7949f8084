#pragma once
// Declares, and says "return 1;" in words alone: needs no test.
struct Plain {
  int value = 0;
};
