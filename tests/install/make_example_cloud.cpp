// Writes a small cloud for the examples: an ellipsoid as a spiral of 20,000 points.
#include <cmath>
#include <fstream>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  constexpr int kPoints = 20'000;
  const double golden_angle = std::acos(-1.0) * (3.0 - std::sqrt(5.0));
  std::ofstream file(argv[1]);
  for (int i = 0; i < kPoints; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kPoints;
    const double radius = std::sqrt(1.0 - z * z);
    file << 1.5 * radius * std::cos(golden_angle * i) << ' ' << radius * std::sin(golden_angle * i)
         << ' ' << 0.8 * z << '\n';
  }
  file.close();
  return file ? 0 : 1;
}
