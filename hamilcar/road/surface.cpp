#include "hamilcar/road/surface.hpp"

#include "hamilcar/road/shared_table.hpp"

namespace hamilcar {

namespace {

template <class Road, class Description>
SharedRoad<Road, Description> shared(const std::shared_ptr<const Description>& description) {
    return {shared_table<Road>(description), description};
}

}  // namespace

Surface::Surface(const RoadDescription& d) {
    for (const ObstacleDescription& obstacle : d.obstacles) elements_.emplace_back(Obstacle(obstacle));
    for (const WaveDescription& wave : d.waves) elements_.emplace_back(Wave(wave));
    for (const RandomRoadDescription& random : d.random) elements_.emplace_back(RandomRoad(random));
    if (d.grid) elements_.emplace_back(shared<HeightGrid>(d.grid));
    if (d.crg) elements_.emplace_back(shared<CrgRoad>(d.crg));
    for (const FrictionPatchDescription& patch : d.patches) patches_.emplace_back(patch);
    for (const SignalDescription& post : d.posts.height) posts_.emplace_back(post);
    for (const SurfaceElement& element : elements_) {
        max_height_ += std::visit([](const auto& one) { return one.max_height(); }, element);
    }
}

std::shared_ptr<const Surface> make_surface(const RoadDescription& description) {
    return description.is_plane() ? nullptr : std::make_shared<const Surface>(description);
}

}  // namespace hamilcar
