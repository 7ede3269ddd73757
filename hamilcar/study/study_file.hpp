// Reads a study file (TOML) into a StudyDescription; docs/files/study.md lists the keys.
#pragma once

#include <string>

#include "hamilcar/io/table_reader.hpp"
#include "hamilcar/study/study.hpp"

namespace hamilcar {

// Throws io::Error (bad_file or input_output) with file, line, column, key, value and expectation.
StudyDescription read_study(const std::string& path);
StudyDescription read_study(const io::TableReader& file);

// For editors (io/schema.hpp).
std::string study_schema();

}  // namespace hamilcar
