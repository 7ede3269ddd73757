// Where the project's files and its program are. Only one source is compiled with these paths, so that a compiler
// cache works for every folder.
#pragma once

#include <string>

namespace hamilcar::test {

std::string source_path(const std::string& relative);  // of a file of this project
const std::string& program_path();

}  // namespace hamilcar::test
