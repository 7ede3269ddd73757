// The one symbol of an engine's shared object.
#include "hamilcar/engine/engine.hpp"

extern "C" [[gnu::visibility("default")]] const hamilcar::Engine* hamilcar_engine() {
    return &hamilcar::engine_parts::engine();
}
