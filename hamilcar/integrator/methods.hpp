// Integration methods as data: coefficients, order, and the extent of their stability region along the negative real axis,
// which limits the stabilization gain (35), (36). A new method is one entry here; its test measures the order and the limit.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace hamilcar {

enum class MethodFamily { adams_bashforth, adams_bashforth_moulton, runge_kutta, embedded_runge_kutta };

struct Method {
    std::string_view name;
    MethodFamily family;
    int order;
    double real_axis_limit;             // largest S with |growth| <= 1 for y' = -S/h y
    std::optional<double> paper_limit;  // ST_k of the paper's Table 3
};

// Adams-Bashforth: b_j multiplies f_{n-j}. Adams-Moulton: a_0 multiplies f_{n+1}, a_j f_{n+1-j}.
inline constexpr int max_adams_order = 7;
using AdamsRow = std::array<double, max_adams_order>;

inline constexpr std::array<AdamsRow, max_adams_order> adams_bashforth{{
    {1},
    {3. / 2, -1. / 2},
    {23. / 12, -16. / 12, 5. / 12},
    {55. / 24, -59. / 24, 37. / 24, -9. / 24},
    {1901. / 720, -2774. / 720, 2616. / 720, -1274. / 720, 251. / 720},
    {4277. / 1440, -7923. / 1440, 9982. / 1440, -7298. / 1440, 2877. / 1440, -475. / 1440},
    {198721. / 60480, -447288. / 60480, 705549. / 60480, -688256. / 60480, 407139. / 60480, -134472. / 60480,
     19087. / 60480},
}};

inline constexpr std::array<AdamsRow, max_adams_order> adams_moulton{{
    {1},
    {1. / 2, 1. / 2},
    {5. / 12, 8. / 12, -1. / 12},
    {9. / 24, 19. / 24, -5. / 24, 1. / 24},
    {251. / 720, 646. / 720, -264. / 720, 106. / 720, -19. / 720},
    {475. / 1440, 1427. / 1440, -798. / 1440, 482. / 1440, -173. / 1440, 27. / 1440},
    {19087. / 60480, 65112. / 60480, -46461. / 60480, 37504. / 60480, -20211. / 60480, 6312. / 60480, -863. / 60480},
}};

// An explicit Runge-Kutta method; `embedded` holds the weights of the lower-order solution if there is one.
inline constexpr int max_stages = 7;
struct Tableau {
    int stages;
    std::array<double, max_stages> nodes;
    std::array<std::array<double, max_stages>, max_stages> stage;
    std::array<double, max_stages> weights;
    std::array<double, max_stages> embedded;
};

inline constexpr Tableau classical_runge_kutta{.stages = 4,
                                               .nodes = {0, 0.5, 0.5, 1},
                                               .stage = {{{}, {0.5}, {0, 0.5}, {0, 0, 1}}},
                                               .weights = {1. / 6, 1. / 3, 1. / 3, 1. / 6},
                                               .embedded = {}};

// Butcher 1964, order 6: starts the Adams methods with a local error of order 7.
inline constexpr Tableau butcher_6{.stages = 7,
                                   .nodes = {0, 1. / 3, 2. / 3, 1. / 3, 5. / 6, 1. / 6, 1},
                                   .stage = {{{},
                                              {1. / 3},
                                              {0, 2. / 3},
                                              {1. / 12, 1. / 3, -1. / 12},
                                              {25. / 48, -55. / 24, 35. / 48, 15. / 8},
                                              {3. / 20, -11. / 24, -1. / 8, 1. / 2, 1. / 10},
                                              {-261. / 260, 33. / 13, 43. / 156, -118. / 39, 32. / 195, 80. / 39}}},
                                   .weights = {13. / 200, 0, 11. / 40, 11. / 40, 4. / 25, 4. / 25, 13. / 200},
                                   .embedded = {}};

// Dormand and Prince 1980, orders 5 and 4.
inline constexpr Tableau dormand_prince{
    .stages = 7,
    .nodes = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1},
    .stage = {{{},
               {1. / 5},
               {3. / 40, 9. / 40},
               {44. / 45, -56. / 15, 32. / 9},
               {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
               {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
               {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}}},
    .weights = {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84, 0},
    .embedded = {5179. / 57600, 0, 7571. / 16695, 393. / 640, -92097. / 339200, 187. / 2100, 1. / 40}};

// The Adams-Bashforth limit is 2 / sum |b_j|; the others are where the growth factor's modulus passes one.
inline constexpr std::array methods{
    Method{"ab1", MethodFamily::adams_bashforth, 1, 2.0, 1.6},
    Method{"ab2", MethodFamily::adams_bashforth, 2, 1.0, 0.8},
    Method{"ab3", MethodFamily::adams_bashforth, 3, 6.0 / 11, 0.4},
    Method{"ab4", MethodFamily::adams_bashforth, 4, 3.0 / 10, 0.2},
    Method{"ab5", MethodFamily::adams_bashforth, 5, 90.0 / 551, 0.1},
    Method{"ab6", MethodFamily::adams_bashforth, 6, 5.0 / 57, 0.05},
    Method{"ab7", MethodFamily::adams_bashforth, 7, 0.046513917259, 0.005},
    Method{"abm2", MethodFamily::adams_bashforth_moulton, 2, 2.0, {}},
    Method{"abm3", MethodFamily::adams_bashforth_moulton, 3, 1.728783568073, {}},
    Method{"abm4", MethodFamily::adams_bashforth_moulton, 4, 1.284816263107, {}},
    Method{"abm5", MethodFamily::adams_bashforth_moulton, 5, 0.946917034537, {}},
    Method{"rk4", MethodFamily::runge_kutta, 4, 2.785293563405, {}},
    Method{"dopri5", MethodFamily::embedded_runge_kutta, 5, 3.306567892635, {}},
};

// The method of that name, or null.
constexpr const Method* find_method(std::string_view name) {
    for (const Method& method : methods) {
        if (method.name == name) return &method;
    }
    return nullptr;
}

}  // namespace hamilcar
