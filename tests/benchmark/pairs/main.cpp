// The comparison without Tight-Inclusion.
#include "judge.h"

int main(int argc, char** argv) { return dartsweep_pairs(argc, argv, nullptr, nullptr); }
