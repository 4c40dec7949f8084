// The test of tested.cpp.
