#include "hamilcar/math/dense.hpp"

#include <Eigen/Dense>

namespace hamilcar {

Eigen::VectorXd solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
    return A.partialPivLu().solve(b);
}

Eigen::VectorXcd solve(const Eigen::MatrixXcd& A, const Eigen::VectorXcd& b) {
    return A.partialPivLu().solve(b);
}

Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
    return A.ldlt().solve(b);
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
    return A.colPivHouseholderQr().solve(b);
}

Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
    return A.completeOrthogonalDecomposition().solve(b);
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& A) {
    return A.inverse();
}

Eigen::VectorXd last_left_singular_vector(const Eigen::MatrixXd& A) {
    return Eigen::JacobiSVD<Eigen::MatrixXd>(A, Eigen::ComputeThinU).matrixU().rightCols<1>();
}

}  // namespace hamilcar
