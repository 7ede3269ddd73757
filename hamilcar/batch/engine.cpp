// One engine: compiled once for each instruction set, with the widest packs it has.
#include "hamilcar/batch/engine.hpp"

#include "hamilcar/batch/lane_chunk.hpp"

namespace hamilcar {
namespace {

#if defined(__AVX512DQ__)
constexpr int register_bytes = 64;
#elif defined(__AVX2__)
constexpr int register_bytes = 32;
#else
constexpr int register_bytes = 16;
#endif
constexpr int lanes_double = register_bytes / sizeof(double), lanes_single = register_bytes / sizeof(float);

Chunk* make_chunk(Precision precision, const LaneCar* cars, int count, const ChunkSettings& settings) {
    if (precision == Precision::single_precision) {
        return new LaneChunk<Pack<float, lanes_single>>(cars, count, settings);
    }
    return new LaneChunk<Pack<double, lanes_double>>(cars, count, settings);
}

}  // namespace
}  // namespace hamilcar

extern "C" [[gnu::visibility("default")]] const hamilcar::BatchEngine* hamilcar_batch_engine() {
    using namespace hamilcar;
    static constexpr BatchEngine engine{BatchEngine::current_version, HAMILCAR_INSTRUCTION_SET, lanes_double,
                                        lanes_single, make_chunk};
    return &engine;
}
