// What an analysis throws where there is nothing to find: a vehicle without a steady motion, a linkage that does not assemble.
// Analyses know no files; callers that do report it as a numerical failure.
#pragma once

#include <stdexcept>

namespace hamilcar {

class NoSolution : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace hamilcar
