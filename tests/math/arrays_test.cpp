// Loops over arrays against scalar loops, to the bit, for lengths that are no multiple of a vector register.
#include "hamilcar/math/arrays.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace hamilcar {
namespace {

template <class T>
class Arrays : public testing::Test {
protected:
    std::vector<T> random(std::size_t count) {
        std::vector<T> out(count);
        for (T& number : out) number = static_cast<T>(unit_(source_));
        return out;
    }

private:
    std::mt19937 source_{7};
    std::uniform_real_distribution<double> unit_{-1, 1};
};
using Numbers = testing::Types<float, double>;
TYPED_TEST_SUITE(Arrays, Numbers);

TYPED_TEST(Arrays, AddWeightedRowsInTheOrderGiven) {
    using T = TypeParam;
    for (const std::size_t size : {1, 5, 8, 67, 1003}) {
        for (int count = 1; count <= 9; ++count) {
            std::vector<std::vector<T>> rows;
            std::vector<const T*> rates;
            for (int j = 0; j < count; ++j) rows.push_back(this->random(size));
            for (const auto& row : rows) rates.push_back(row.data());
            const std::vector<T> weights = this->random(static_cast<std::size_t>(count)), from = this->random(size);
            std::vector<T> to(size), in_place = from;
            add_weighted(from.data(), rates.data(), weights.data(), count, to.data(), static_cast<int>(size));
            add_weighted(in_place.data(), rates.data(), weights.data(), count, in_place.data(), static_cast<int>(size));
            for (std::size_t i = 0; i < size; ++i) {
                volatile T sum = weights[0] * rows[0][i];  // volatile: one rounding per operation
                for (std::size_t j = 1; j < rows.size(); ++j) {
                    const volatile T term = weights[j] * rows[j][i];
                    sum = sum + term;
                }
                const T expected = from[i] + sum;
                ASSERT_EQ(to[i], expected) << size << ", " << count << ", " << i;
                ASSERT_EQ(in_place[i], expected);
            }
        }
    }
}

TYPED_TEST(Arrays, AddScaledRows) {
    using T = TypeParam;
    for (const std::size_t size : {1, 3, 16, 259}) {
        const std::vector<T> x = this->random(size), before = this->random(size);
        std::vector<T> to = before;
        add_scaled(T(0.3), x.data(), to.data(), static_cast<int>(size));
        for (std::size_t i = 0; i < size; ++i) {
            const volatile T term = T(0.3) * x[i];
            ASSERT_EQ(to[i], before[i] + term);
        }
    }
}

TYPED_TEST(Arrays, DetectNonFiniteNumbers) {
    using T = TypeParam;
    using Limits = std::numeric_limits<T>;
    for (const std::size_t size : {1, 7, 64, 515}) {
        std::vector<T> numbers = this->random(size);
        numbers[0] = Limits::max(), numbers[size / 2] = Limits::denorm_min();
        EXPECT_TRUE(all_finite(numbers.data(), static_cast<int>(size)));
        for (const T bad : {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(), -Limits::quiet_NaN()}) {
            for (const std::size_t place : {std::size_t{0}, size / 3, size - 1}) {
                std::vector<T> spoiled = numbers;
                spoiled[place] = bad;
                EXPECT_FALSE(all_finite(spoiled.data(), static_cast<int>(size))) << bad << " at " << place;
            }
        }
    }
}

}  // namespace
}  // namespace hamilcar
