#include "hamilcar/base/assert.hpp"

#include <cstdio>
#include <cstdlib>

namespace hamilcar {

void assertion_failed(const char* condition, const char* file, int line) {
    std::fprintf(stderr, "hamilcar: %s:%d: assertion failed: %s\n", file, line, condition);
    std::abort();
}

}  // namespace hamilcar
