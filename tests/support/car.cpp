#include "support/car.hpp"

#include <gtest/gtest.h>

namespace hamilcar::test {

void run_to_end(Simulation& simulation) {
    while (!simulation.finished()) {
        const auto end = simulation.advance();
        if (end) FAIL() << end->message;
    }
}

}  // namespace hamilcar::test
