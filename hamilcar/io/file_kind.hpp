// What kind of file somebody gave, where another was expected: a message about its first line would not help.
#pragma once

#include <functional>
#include <string>

namespace hamilcar::io {

enum class FileKind { vehicle, scenario, study, tire, measured_road, results, outcome, folder, other };

// By what stands in it.
FileKind kind_of_file(const std::string& path);

// Throws what `read` throws; where the file is of another kind, an Error that says which, and what it is for.
void expect_kind(const std::string& path, FileKind wanted, const std::function<void()>& read);

}  // namespace hamilcar::io
