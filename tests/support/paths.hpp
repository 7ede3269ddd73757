// Where the project's files and its program are. One source alone is told, so that a compiler's cache serves every folder.
#pragma once

#include <string>

namespace hamilcar::test {

std::string source_path(const std::string& relative);  // of a file of this project
const std::string& program_path();

}  // namespace hamilcar::test
