// Sums over the spokes of a car in one order, whatever number carries them: first the spokes at each place of the rows,
// then the places. A car that runs its spokes abreast and one that runs them one by one get the same bits.
#pragma once

#include <array>

#include "hamilcar/vehicle/row.hpp"

namespace hamilcar {

template <class T, class S, std::size_t count>
class PlaceSum {
public:
    PlaceSum() {
        for (auto& place : sums_) place.fill(S(0));
    }

    template <class Row>
    HAMILCAR_CORE void add(std::array<S, count> share, const Row& row) {
        if constexpr (width == 1) {
            auto& sum = sums_[static_cast<std::size_t>(row.place)];
            for (std::size_t k = 0; k < count; ++k) sum[k] += share[k];
        } else {
            for (int vacant = row.count; vacant < width; ++vacant) {
                for (S& number : share) set_lane(number, vacant, T(0));
            }
            for (std::size_t k = 0; k < count; ++k) sums_[0][k] += share[k];
        }
    }

    HAMILCAR_CORE std::array<T, count> total() const {
        std::array<T, count> out;
        for (std::size_t k = 0; k < count; ++k) {
            if constexpr (width == 1) {
                out[k] = sums_[0][k] + sums_[1][k];
            } else {
                out[k] = lane(sums_[0][k], 0) + lane(sums_[0][k], 1);
            }
        }
        return out;
    }

private:
    static constexpr int width = row_width<S, T>;
    static_assert(width == 1 || width == places_abreast);
    std::array<std::array<S, count>, width == 1 ? places_abreast : 1> sums_;
};

}  // namespace hamilcar
