// Dense systems of equations of any size. Eigen's decompositions are long tasks for the compiler: they are compiled here, once.
#pragma once

#include "hamilcar/math/eigen.hpp"

namespace hamilcar {

// Of a regular square matrix.
Eigen::VectorXd solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::VectorXcd solve(const Eigen::MatrixXcd& A, const Eigen::VectorXcd& b);
// Of a symmetric matrix that is positive semidefinite.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
// The x that A x comes nearest to b with, columns of A independent; and the shortest such x, of any A.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& A);
// The unit vector u for which u' A, with the rows of A independent, is shortest.
Eigen::VectorXd last_left_singular_vector(const Eigen::MatrixXd& A);

}  // namespace hamilcar
