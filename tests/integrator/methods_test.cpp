// The methods' numbers against the conditions that define them: Adams rows integrate polynomials exactly and miss the next
// degree by the textbook's constant; tableaux satisfy Butcher's condition for every rooted tree up to their order.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "hamilcar/integrator/methods.hpp"

namespace hamilcar {
namespace {

// What sum_j row[j] x_j^m misses of the integral of t^m over the step, for rates known at the points x_j.
double missing(const AdamsRow& row, int first_point, int degree) {
    double sum = 0;
    for (int j = 0; j < max_adams_order; ++j) {
        const double power = degree == 0 ? 1 : std::pow(first_point - j, degree);
        sum += row[static_cast<std::size_t>(j)] * power;
    }
    return 1.0 / (degree + 1) - sum;
}

double factorial(int n) {
    return n < 2 ? 1 : n * factorial(n - 1);
}

void check_adams_row(const AdamsRow& row, int first_point, int order, double error_constant) {
    double scale = 0;
    for (int j = 0; j < max_adams_order; ++j) {
        scale += std::abs(row[static_cast<std::size_t>(j)]) * std::pow(std::abs(first_point - j), order);
        EXPECT_TRUE(j < order || row[static_cast<std::size_t>(j)] == 0) << "longer than its order";
    }
    const double round_off = 1e-15 * (1 + scale);
    for (int degree = 0; degree < order; ++degree) EXPECT_NEAR(missing(row, first_point, degree), 0, round_off);
    EXPECT_NEAR(missing(row, first_point, order), factorial(order) * error_constant, round_off);
}

// Error constants from the generating functions (Hairer, Norsett, Wanner I, III.1).
TEST(AdamsBashforth, IntegratesPolynomialsUpToItsOrder) {
    const std::array constants{1. / 2, 5. / 12, 3. / 8, 251. / 720, 95. / 288, 19087. / 60480, 5257. / 17280};
    for (int k = 1; k <= max_adams_order; ++k) {
        SCOPED_TRACE(k);
        check_adams_row(adams_bashforth[static_cast<std::size_t>(k - 1)], 0, k,
                        constants[static_cast<std::size_t>(k - 1)]);
    }
}

TEST(AdamsMoulton, IntegratesPolynomialsUpToItsOrder) {
    const std::array constants{-1. / 2, -1. / 12, -1. / 24, -19. / 720, -3. / 160, -863. / 60480, -275. / 24192};
    for (int k = 1; k <= max_adams_order; ++k) {
        SCOPED_TRACE(k);
        check_adams_row(adams_moulton[static_cast<std::size_t>(k - 1)], 1, k,
                        constants[static_cast<std::size_t>(k - 1)]);
    }
}

// A rooted tree: its order counts the vertices, its density gamma is the order times the branches' densities.
struct Tree {
    std::vector<Tree> branches;
    int order = 1;
    double density = 1;
};

Tree join(const std::vector<Tree>& branches) {
    Tree tree{branches};
    for (const Tree& branch : branches) tree.order += branch.order, tree.density *= branch.density;
    tree.density *= tree.order;
    return tree;
}

// Every rooted tree with 1, 2, ..., highest vertices.
std::vector<std::vector<Tree>> rooted_trees(int highest) {
    std::vector<std::vector<Tree>> of_order(1);
    std::vector<Tree> smaller;
    for (int order = 1; order <= highest; ++order) {
        std::vector<Tree> found, branches;
        const std::function<void(int, std::size_t)> choose = [&](int left, std::size_t first) {
            if (left == 0) found.push_back(join(branches));
            for (std::size_t i = first; i < smaller.size() && left > 0; ++i) {
                if (smaller[i].order > left) continue;
                branches.push_back(smaller[i]);
                choose(left - smaller[i].order, i);
                branches.pop_back();
            }
        };
        choose(order - 1, 0);
        smaller.insert(smaller.end(), found.begin(), found.end());
        of_order.push_back(found);
    }
    return of_order;
}

using Stages = std::array<double, max_stages>;

// Product over the branches of A applied to what the branch gives.
Stages stage_weights(const Tableau& method, const Tree& tree) {
    Stages out{};
    out.fill(1);
    for (const Tree& branch : tree.branches) {
        const Stages inner = stage_weights(method, branch);
        for (std::size_t i = 0; i < max_stages; ++i) {
            double sum = 0;
            for (std::size_t j = 0; j < max_stages; ++j) sum += method.stage[i][j] * inner[j];
            out[i] *= sum;
        }
    }
    return out;
}

// Largest violation of sum_i b_i Phi_i(t) = 1 / gamma(t) over the trees of one order.
double violation(const Tableau& method, const Stages& weights, const std::vector<Tree>& trees) {
    double worst = 0;
    for (const Tree& tree : trees) {
        const Stages stages = stage_weights(method, tree);
        double sum = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(method.stages); ++i) sum += weights[i] * stages[i];
        worst = std::max(worst, std::abs(sum - 1 / tree.density));
    }
    return worst;
}

void check_order(const Tableau& method, const Stages& weights, int order) {
    const auto trees = rooted_trees(order + 1);
    for (int p = 1; p <= order; ++p) {
        EXPECT_LE(violation(method, weights, trees[static_cast<std::size_t>(p)]), 1e-14) << "order " << p;
    }
    EXPECT_GE(violation(method, weights, trees[static_cast<std::size_t>(order + 1)]), 1e-5) << "order is understated";
}

TEST(RootedTrees, AreAsManyAsThereAre) {
    const auto trees = rooted_trees(7);
    const std::array<std::size_t, 8> known{0, 1, 1, 2, 4, 9, 20, 48};
    for (std::size_t p = 1; p < known.size(); ++p) EXPECT_EQ(trees[p].size(), known[p]);
}

TEST(Tableau, StagesStandAtTheirNodes) {
    for (const Tableau& method : {classical_runge_kutta, butcher_6, dormand_prince}) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(method.stages); ++i) {
            double sum = 0;
            for (std::size_t j = 0; j < max_stages; ++j) {
                sum += method.stage[i][j];
                EXPECT_TRUE(j < i || method.stage[i][j] == 0) << "an explicit method looks back only";
            }
            EXPECT_NEAR(sum, method.nodes[i], 5e-15) << "terms up to 12";
        }
    }
}

TEST(Tableau, ClassicalRungeKuttaHasOrderFour) {
    check_order(classical_runge_kutta, classical_runge_kutta.weights, 4);
}
TEST(Tableau, ButcherHasOrderSix) {
    check_order(butcher_6, butcher_6.weights, 6);
}
TEST(Tableau, DormandPrinceHasOrdersFiveAndFour) {
    check_order(dormand_prince, dormand_prince.weights, 5);
    check_order(dormand_prince, dormand_prince.embedded, 4);
}

// On the negative real axis the first root to leave the unit circle is -1: 2 / sum |b_j|.
TEST(AdamsBashforth, RealAxisLimitsAreTheExactFractions) {
    const std::array exact{2.0, 1.0, 6. / 11, 3. / 10, 90. / 551, 5. / 57, 1890. / 40633};
    for (std::size_t k = 1; k <= exact.size(); ++k) {
        const Method* method = find_method("ab" + std::to_string(k));
        ASSERT_NE(method, nullptr);
        double sum = 0;
        for (const double b : adams_bashforth[k - 1]) sum += std::abs(b);
        EXPECT_NEAR(method->real_axis_limit, 2 / sum, 1e-12);
        EXPECT_NEAR(method->real_axis_limit, exact[k - 1], 1e-12);
    }
}

// One step for y' = z y with h = 1 as a matrix on (y_n, ..., y_{n-k+1}); its largest eigenvalue is the growth per step.
double growth(const Method& method, double z) {
    const auto k = static_cast<Eigen::Index>(method.order);
    const bool adams = method.family <= MethodFamily::adams_bashforth_moulton;
    if (!adams) {
        const Tableau& t = method.family == MethodFamily::runge_kutta ? classical_runge_kutta : dormand_prince;
        Stages rate{};
        for (std::size_t i = 0; i < max_stages; ++i) {
            rate[i] = 1;
            for (std::size_t j = 0; j < i; ++j) rate[i] += z * t.stage[i][j] * rate[j];
        }
        double y = 1;
        for (std::size_t i = 0; i < max_stages; ++i) y += z * t.weights[i] * rate[i];
        return std::abs(y);
    }
    const AdamsRow &b = adams_bashforth[static_cast<std::size_t>(k - 1)],
                   &a = adams_moulton[static_cast<std::size_t>(k - 1)];
    Eigen::MatrixXd step = Eigen::MatrixXd::Zero(k, k);
    step(0, 0) = 1;
    for (Eigen::Index j = 0; j < k; ++j) step(0, j) += z * b[static_cast<std::size_t>(j)];
    if (method.family == MethodFamily::adams_bashforth_moulton) {  // predicted, evaluated, corrected
        step.row(0) *= z * a[0];
        step(0, 0) += 1;
        for (Eigen::Index j = 0; j + 1 < k; ++j) step(0, j) += z * a[static_cast<std::size_t>(j + 1)];
    }
    for (Eigen::Index j = 1; j < k; ++j) step(j, j - 1) = 1;
    return step.eigenvalues().cwiseAbs().maxCoeff();
}

TEST(Methods, RealAxisLimitIsWhereTheGrowthPassesOne) {
    for (const Method& method : methods) {
        const double limit = method.real_axis_limit, margin = 1e-7;  // abm2 has a double root: half the digits
        EXPECT_LT(growth(method, -limit * (1 - margin)), 1) << method.name;
        EXPECT_GT(growth(method, -limit * (1 + margin)), 1) << method.name;
        for (double share = 0.02; share < 0.99; share += 0.02)
            EXPECT_LT(growth(method, -share * limit), 1) << method.name;
    }
}

// Table 3 of the paper: on the safe side of every limit.
TEST(AdamsBashforth, PaperLimitsAreThePrintedOnes) {
    const std::array printed{1.6, 0.8, 0.4, 0.2, 0.1, 0.05, 0.005};
    for (std::size_t k = 1; k <= printed.size(); ++k) {
        const Method* method = find_method("ab" + std::to_string(k));
        ASSERT_TRUE(method && method->paper_limit);
        EXPECT_EQ(*method->paper_limit, printed[k - 1]);
        EXPECT_LT(*method->paper_limit, method->real_axis_limit);
    }
}

TEST(Methods, AreFoundByTheirNamesAlone) {
    for (const Method& method : methods) EXPECT_EQ(find_method(method.name), &method);
    EXPECT_EQ(find_method("euler"), nullptr);
    EXPECT_EQ(find_method(""), nullptr);
}

}  // namespace
}  // namespace hamilcar
