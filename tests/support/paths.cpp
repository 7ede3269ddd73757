#include "support/paths.hpp"

namespace hamilcar::test {

std::string source_path(const std::string& relative) {
    return HAMILCAR_SOURCE_DIR "/" + relative;
}

const std::string& program_path() {
    static const std::string path = HAMILCAR_PROGRAM;
    return path;
}

}  // namespace hamilcar::test
