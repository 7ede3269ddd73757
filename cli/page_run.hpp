// Results that are read back to be shown.
#pragma once

#include <string>

#include "hamilcar/io/page.hpp"

namespace hamilcar::cli {

// At most `rows` rows of a result file, named by its title. Says on standard error what is not shown. Throws as
// io::read_result does.
io::PageRun read_run(const std::string& path, long rows);

}  // namespace hamilcar::cli
