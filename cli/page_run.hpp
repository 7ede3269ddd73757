// Results that are read back to be shown.
#pragma once

#include <cstddef>
#include <string>

#include "hamilcar/io/page.hpp"

namespace hamilcar::cli {

// The rows of a result file, named by its title, at most its share of those that `runs` of them may have together. Says on standard
// error what is not shown. Throws as io::read_result does.
io::PageRun read_run(const std::string& path, long rows, std::size_t runs);

}  // namespace hamilcar::cli
