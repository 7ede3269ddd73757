// The one symbol of an engine's shared object.
#include "hamilcar/engine/engine.hpp"

extern "C" [[gnu::visibility("default")]] const hamilcar::Engine* HAMILCAR_ENGINE_FUNCTION() {
    return &hamilcar::engine_parts::engine();
}
