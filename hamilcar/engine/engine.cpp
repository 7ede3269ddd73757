#include "hamilcar/engine/engine.hpp"

#include "hamilcar/engine/lanes.hpp"

#ifndef HAMILCAR_INSTRUCTION_SET  // inside the library itself
#define HAMILCAR_INSTRUCTION_SET "baseline"
#endif

namespace hamilcar::engine_parts {

const Engine& engine() {
    static constexpr Engine own{.instruction_set = HAMILCAR_INSTRUCTION_SET,
                                .lanes_double = lanes_double,
                                .lanes_single = lanes_single,
                                .advance_car = advance_car,
                                .make_chunk = make_chunk,
                                .multiply_and_add = multiply_and_add};
    return own;
}

}  // namespace hamilcar::engine_parts
