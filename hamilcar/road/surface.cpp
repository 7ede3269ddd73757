#include "hamilcar/road/surface.hpp"

#include <map>
#include <mutex>

namespace hamilcar {

namespace {

// One table shared by all surfaces of one description, so that a batch on a large file stores it once. The table keeps the
// description alive, so that its address identifies it.
template <class Road, class Description>
SharedRoad<Road, Description> shared(const std::shared_ptr<const Description>& description) {
    static std::mutex mutex;
    static std::map<const Description*, std::weak_ptr<const Road>> cache;
    const std::lock_guard lock(mutex);
    std::erase_if(cache, [](const auto& entry) { return entry.second.expired(); });
    std::shared_ptr<const Road> road = cache[description.get()].lock();
    if (!road) cache[description.get()] = road = std::make_shared<const Road>(*description);
    return {road, description};
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
