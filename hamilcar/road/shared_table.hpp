// A road's table shared by all who use one description, so that a batch on a large file stores it once.
#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "hamilcar/road/surface.hpp"

namespace hamilcar {

// The table keeps the description alive where it is held with it (SharedRoad), so that its address identifies it.
template <class Road, class Description>
std::shared_ptr<const Road> shared_table(const std::shared_ptr<const Description>& description) {
    static std::mutex mutex;
    static std::map<const Description*, std::weak_ptr<const Road>> cache;
    const std::lock_guard lock(mutex);
    std::erase_if(cache, [](const auto& entry) { return entry.second.expired(); });
    std::shared_ptr<const Road> road = cache[description.get()].lock();
    if (!road) cache[description.get()] = road = std::make_shared<const Road>(*description);
    return road;
}

}  // namespace hamilcar
