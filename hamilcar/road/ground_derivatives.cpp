#include "hamilcar/road/traced_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hamilcar {

namespace {

using PoseNumbers = std::array<double, PatchPose<double>::count>;
using PlaneNumbers = std::array<double, PatchPlane<double>::count>;

constexpr double spacing = 1e-5;  // of the differences, in the unit of each argument

struct GroundBelow {
    const Surface* surface;
    int wheel;
    double time;

    PlaneNumbers at(const PoseNumbers& numbers) const {
        PatchPose<double> place;
        auto number = numbers.begin();
        PatchPose<double>::for_each(place, [&](double& to) { to = *number++; });
        PlaneNumbers out{};
        auto to = out.begin();
        PatchPlane<double>::for_each(surface->under(place, wheel, time), [&](double from) { *to++ = from; });
        return out;
    }
    // Rates of the plane's numbers along a direction; whether there is ground at all has none.
    PlaneNumbers along(const PoseNumbers& pose, const PoseNumbers& direction) const {
        if (!surface) return {};
        PoseNumbers ahead = pose, behind = pose;
        for (std::size_t i = 0; i < pose.size(); ++i) {
            ahead[i] += spacing * direction[i], behind[i] -= spacing * direction[i];
        }
        const PlaneNumbers after = at(ahead), before = at(behind);
        PlaneNumbers out{};
        for (std::size_t i = 0; i + 1 < out.size(); ++i) out[i] = (after[i] - before[i]) / (2 * spacing);
        return out;
    }
};

GroundBelow below(const void* context, int wheel, int lane) {
    const auto& ground = *static_cast<const LaneSurfaces*>(context);
    return {ground.surfaces[lane], wheel, ground.times[lane] + ground.ahead};
}

// Number by number, each for all lanes.
template <std::size_t count>
std::array<double, count> read(const void* from, std::size_t first, int lanes, int lane) {
    std::array<double, count> out;
    const double* numbers = static_cast<const double*>(from) + lane;
    for (std::size_t i = 0; i < count; ++i) out[i] = numbers[(first + i) * static_cast<std::size_t>(lanes)];
    return out;
}
template <std::size_t count>
void write(const std::array<double, count>& from, void* to, int lanes, int lane) {
    double* numbers = static_cast<double*>(to) + lane;
    for (std::size_t i = 0; i < count; ++i) numbers[i * static_cast<std::size_t>(lanes)] = from[i];
}

}  // namespace

void ground_tangents(const void* context, int wheel, int lanes, const void* arguments, void* results) {
    constexpr std::size_t count = PatchPose<double>::count;
    for (int lane = 0; lane < lanes; ++lane) {
        const PoseNumbers pose = read<count>(arguments, 0, lanes, lane);
        PoseNumbers direction = read<count>(arguments, count, lanes, lane);
        // As short as the spacing assumes, whatever the tangent's size.
        double size = 0;
        for (const double one : direction) size = std::max(size, std::abs(one));
        if (size > 0) {
            for (double& one : direction) one /= size;
        }
        PlaneNumbers rates = below(context, wheel, lane).along(pose, direction);
        for (double& one : rates) one *= size;
        write(rates, results, lanes, lane);
    }
}

void ground_adjoints(const void* context, int wheel, int lanes, const void* arguments, void* results) {
    constexpr std::size_t count = PatchPose<double>::count;
    for (int lane = 0; lane < lanes; ++lane) {
        const PoseNumbers pose = read<count>(arguments, 0, lanes, lane);
        const PlaneNumbers adjoint = read<PatchPlane<double>::count>(arguments, count, lanes, lane);
        PoseNumbers out{};
        for (std::size_t i = 0; i < count; ++i) {
            PoseNumbers direction{};
            direction[i] = 1;
            const PlaneNumbers rates = below(context, wheel, lane).along(pose, direction);
            for (std::size_t k = 0; k < rates.size(); ++k) out[i] += rates[k] * adjoint[k];
        }
        write(out, results, lanes, lane);
    }
}

}  // namespace hamilcar
