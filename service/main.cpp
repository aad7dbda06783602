#include "gridcull/service/program.h"

int main(int argc, char** argv) { return gridcull::run_program(argc, argv); }
