// Dual numbers against differences, function by function; and as numbers like any other: their values are those of doubles.
#include "hamilcar/math/dual.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <functional>

#include "hamilcar/math/small_solve.hpp"
#include "support/difference.hpp"

namespace hamilcar {
namespace {

using D = Dual<double, 2>;

struct Function {
    const char* name;
    std::function<double(double)> plain;
    std::function<D(const D&)> dual;
};

template <class F>
Function both(const char* name, F f) {
    return {name, [f](double x) { return f(x); }, [f](const D& x) { return f(x); }};
}

TEST(Dual, DerivativesAreThoseOfDifferences) {
    const Function functions[] = {
        both("sum", [](auto x) { return x + 2.0 - x * 3.0; }),
        both("product", [](auto x) { return x * x * x; }),
        both("quotient", [](auto x) { return (x + 1.0) / (x * x + 2.0); }),
        both("root", [](auto x) { return sqrt(x * x + 1.0); }),
        both("over_root", [](auto x) { return over_root(x, decltype(x)(x * x + 0.5)); }),
        both("absolute", [](auto x) { return abs(x) * x; }),
        both("least", [](auto x) { return min(x, decltype(x)(x * x)); }),
        both("clamped", [](auto x) { return clamp(x, decltype(x)(-0.2), decltype(x)(0.6)) * x; }),
        both("sine", [](auto x) { return sincos(decltype(x)(x * 1.7)).sine; }),
        both("cosine beyond a quarter turn", [](auto x) { return sincos(decltype(x)(x * 9.0)).cosine; })};
    for (const Function& f : functions) {
        for (const double x : {-1.3, -0.4, 0.3, 0.9, 2.1}) {
            const D y = f.dual(D::variable(x, 1));
            EXPECT_EQ(y.value(), f.plain(x)) << f.name << " at " << x;
            EXPECT_NEAR(y.partial(1), test::derivative(f.plain, x), 1e-8 * (1 + std::abs(y.partial(1))))
                << f.name << " at " << x;
            EXPECT_EQ(y.partial(0), 0) << f.name;
        }
    }
}

TEST(Dual, CarriesPartialsThroughMatrices) {
    Matrix<D, 3, 3> A = Matrix<D, 3, 3>::Identity();
    A(0, 1) = D::variable(0.5, 0), A(2, 0) = D::variable(-0.3, 1);
    A(1, 2) = D(0.7);
    Matrix<D, 3, 3> B = A;
    const D determinant = invert_in_place<D, 3>(B, 3);
    const auto of = [](double a, double b) {
        Matrix<double, 3, 3> M = Matrix<double, 3, 3>::Identity();
        M(0, 1) = a, M(2, 0) = b, M(1, 2) = 0.7;
        return M;
    };
    EXPECT_NEAR(determinant.partial(0), test::derivative([&](double a) { return of(a, -0.3).determinant(); }, 0.5),
                1e-10);
    EXPECT_NEAR(B(1, 0).partial(1),
                test::derivative([&](double b) { return Mat3<double>(of(0.5, b).inverse())(1, 0); }, -0.3), 1e-10);
}

}  // namespace
}  // namespace hamilcar
