// What an uneven road is the sum of, as a person writes it down. Ground axes: x ahead, y left, z up; all in SI units.
//
// Every ramp and fade lies inside the range it belongs to: outside the range an element is not there at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "hamilcar/description/crg.hpp"
#include "hamilcar/description/signal.hpp"

namespace hamilcar {

inline constexpr double everywhere = std::numeric_limits<double>::infinity();

enum class ObstacleShape {
    plateau,  // a cleat, a step up and down, a pothole: level between its ramps
    hump      // a speed bump: one full raised cosine over the length
};

// One obstacle, or a row of the same ones.
struct ObstacleDescription {
    ObstacleShape shape = ObstacleShape::plateau;
    double start = 0, length = 1;                   // along x [m]
    double height = 0;                              // negative: a pothole [m]
    double ramp = 0.05;                             // of a plateau, at both ends, above zero [m]
    double right = -everywhere, left = everywhere;  // along y [m]
    double side_ramp = 0.05;                        // at both sides, above zero [m]
    double repeat_every = 0;  // from start to start, at least `length`, with a count above one [m]
    int count = 1;
};

// A sine along x; a swept one where the last wavelength differs from the first.
struct WaveDescription {
    double start = 0, length = 0;  // length 0: endless, and then not swept [m]
    double amplitude = 0;          // [m]
    double wavelength = 1;         // at the start [m]
    double last_wavelength = 0;    // at the end; 0: as at the start [m]
    double right_phase = 0;        // by which the right track (y < 0) lags the left one [rad]
};

// A road with the spectrum of an ISO 8608 class and two tracks correlated as on an isotropic surface.
struct RandomRoadDescription {
    char road_class = 'A';          // A (very good) to H
    std::uint64_t seed = 1;         // another seed: another road of the same class
    std::uint32_t case_number = 0;  // of a batch that varies the road
    std::uint32_t stream = 0;       // tells several random roads of one scenario apart
    double start = 0, length = 0;   // length 0: endless, and then periodic [m]
    double track_width = 1.5;       // between the tracks [m]
    double fade = 5;                // from nothing to the full road, and back at the end of a length, above zero [m]
    double spacing = 0.05;          // of the table, at most 0.1 [m]
};

// Heights at the nodes of a grid. Outside: the height of the nearest edge.
struct HeightGridDescription {
    double x = 0, y = 0;                  // of the first node [m]
    double spacing_x = 1, spacing_y = 1;  // above zero [m]
    std::size_t rows = 0, columns = 0;    // nodes along y and along x
    std::vector<double> heights;          // one row after the other, each along x [m]
};

// Where the road grips differently.
struct FrictionPatchDescription {
    double start = -everywhere, end = everywhere;   // along x [m]
    double right = -everywhere, left = everywhere;  // along y [m]
    double friction = 1;                            // factor on the tire's friction [1]
    double ramp = 0.1;                              // at all four edges, above zero [m]
};

// A post under each wheel, in the vehicle's order of wheels, that moves up and down; wheels beyond the list have none.
struct PostsDescription {
    std::vector<SignalDescription> height;  // [m]
};

// A plane with everything that stands on it. Grade: rise over run along ground x (uphill positive); bank: rise over run along
// ground y.
struct RoadDescription {
    double grade = 0, bank = 0;  // [1]
    double friction = 1;         // factor on the tire's friction [1]
    std::vector<ObstacleDescription> obstacles;
    std::vector<WaveDescription> waves;
    std::vector<RandomRoadDescription> random;
    std::shared_ptr<const HeightGridDescription> grid;
    std::shared_ptr<const CrgDescription> crg;
    std::vector<FrictionPatchDescription> patches;
    PostsDescription posts;

    bool is_plane() const {
        return obstacles.empty() && waves.empty() && random.empty() && !grid && !crg && patches.empty() &&
               posts.height.empty();
    }
    // Whether it has heights of its own to be seen, which patches of friction and posts under wheels are not.
    bool is_uneven() const { return !obstacles.empty() || !waves.empty() || !random.empty() || grid || crg; }
};

}  // namespace hamilcar
