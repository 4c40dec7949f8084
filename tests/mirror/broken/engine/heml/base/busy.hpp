#pragma once
// A header with a statement.
inline int busy() { return 1; }
