#include "scene/builtin/random.h"

#include <cmath>

namespace sundial::builtin {

namespace {
constexpr double kTau = 6.283185307179586476925;

// Taylor series around 0, for |x| <= pi / 4.
double sinSeries(double x) {
  const double s = x * x;
  double sum = 0;
  for (int n = 17; n >= 3; n -= 2) sum = (sum + 1) * -s / (n * (n - 1));
  return x * (1 + sum);
}
double cosSeries(double x) {
  const double s = x * x;
  double sum = 0;
  for (int n = 18; n >= 2; n -= 2) sum = (sum + 1) * -s / (n * (n - 1));
  return 1 + sum;
}
}  // namespace

double sinTurns(double turns) {
  const double t = turns - std::floor(turns);
  const double quarter = std::floor(t * 4 + 0.5);
  const double x = (t - quarter / 4) * kTau;
  switch (static_cast<int>(quarter) % 4) {
    case 0:
      return sinSeries(x);
    case 1:
      return cosSeries(x);
    case 2:
      return -sinSeries(x);
    default:
      return -cosSeries(x);
  }
}

double cosTurns(double turns) { return sinTurns(turns + 0.25); }

}  // namespace sundial::builtin
