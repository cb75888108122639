#include "affine.h"

#include <algorithm>
#include <cmath>

namespace osgRoam {

double greatestStretch(const osg::Matrixd& matrix) {
  // The eigenvalues of the symmetric matrix S = A A^T in closed form (Smith, "Eigenvalues of a symmetric 3x3 matrix",
  // Communications of the ACM 4, 1961).
  double s[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      s[i][j] = 0.0;
      for (int k = 0; k < 3; ++k) s[i][j] += matrix(i, k) * matrix(j, k);
    }
  }
  const double mean = (s[0][0] + s[1][1] + s[2][2]) / 3.0;
  double squares = 0.0;
  for (int i = 0; i < 3; ++i) {
    s[i][i] -= mean;
    for (int j = 0; j < 3; ++j) squares += s[i][j] * s[i][j];
  }
  const double p = std::sqrt(squares / 6.0);
  double greatest = mean;
  if (p > 0.0) {
    const double determinant = s[0][0] * (s[1][1] * s[2][2] - s[1][2] * s[2][1]) -
                               s[0][1] * (s[1][0] * s[2][2] - s[1][2] * s[2][0]) +
                               s[0][2] * (s[1][0] * s[2][1] - s[1][1] * s[2][0]);
    const double cosine = std::clamp(determinant / (2.0 * p * p * p), -1.0, 1.0);
    greatest = mean + 2.0 * p * std::cos(std::acos(cosine) / 3.0);
  }
  // With equal eigenvalues the formula loses half of the digits.
  constexpr double rounding = 1e-6;
  return std::sqrt(std::max(greatest, 0.0)) * (1.0 + rounding);
}

bool isInverse(const osg::Matrixd& matrix, const osg::Matrixd& inverse) {
  constexpr double tolerance = 1e-11;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      double product = i == j ? -1.0 : 0.0;
      for (int k = 0; k < 3; ++k) product += matrix(i, k) * inverse(k, j);
      if (!(std::abs(product) <= tolerance)) return false;
    }
  }
  return true;
}

osg::Vec3d turnedHalf(const osg::Vec3d& half, const osg::Matrixd& matrix) {
  osg::Vec3d turned;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) turned[j] += std::abs(matrix(i, j)) * half[i];
  }
  return turned;
}

}  // namespace osgRoam
