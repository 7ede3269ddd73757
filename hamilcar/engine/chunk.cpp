#include "hamilcar/engine/lane_chunk.hpp"
#include "hamilcar/engine/lanes.hpp"

namespace hamilcar::engine_parts {

Chunk* make_chunk(Precision precision, const LaneCar* cars, int count, const ChunkSettings& settings) {
    if (precision == Precision::single_precision) {
        return new LaneChunk<Pack<float, lanes_single>>(cars, count, settings);
    }
    return new LaneChunk<Pack<double, lanes_double>>(cars, count, settings);
}

}  // namespace hamilcar::engine_parts
