// gnuplot, found at run time.
#pragma once

#include <string>

namespace gridcull {

/// Path of the program `gnuplot` by PATH; "" where there is none.
std::string find_gnuplot();

/// Runs a script file with arguments ARG1, ARG2 ... Throws Error(io) with what gnuplot said when it fails.
void run_gnuplot(const std::string& gnuplot, const std::string& script, const std::string& arg1,
                 const std::string& arg2);

}  // namespace gridcull
