// A vector of fixed capacity, without heap memory, that constructs only the elements in use.
#pragma once

#include <array>
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>

#include "hamilcar/base/assert.hpp"

namespace hamilcar {

template <class T, std::size_t capacity>
class StaticVector {
    static_assert(std::is_trivially_destructible_v<T>);

public:
    StaticVector() {}
    StaticVector(const StaticVector& other) { *this = other; }
    StaticVector& operator=(const StaticVector& other) {
        if (this == &other) return *this;
        size_ = 0;
        for (std::size_t i = 0; i < other.size_; ++i) emplace_back(other[i]);
        return *this;
    }

    template <class... Arguments>
    T& emplace_back(Arguments&&... arguments) {
        HAMILCAR_ASSERT(size_ < capacity);
        return *new (bytes_ + sizeof(T) * size_++) T(std::forward<Arguments>(arguments)...);
    }
    std::size_t size() const { return size_; }
    T& operator[](std::size_t i) {
        HAMILCAR_ASSERT(i < size_);
        return *std::launder(reinterpret_cast<T*>(bytes_ + sizeof(T) * i));
    }
    const T& operator[](std::size_t i) const {
        HAMILCAR_ASSERT(i < size_);
        return *std::launder(reinterpret_cast<const T*>(bytes_ + sizeof(T) * i));
    }

private:
    alignas(T) std::byte bytes_[capacity * sizeof(T)];
    std::size_t size_ = 0;
};

}  // namespace hamilcar
