// Meshes a cloud by PCL's greedy projection, for comparison only: pcl_peer IN.xyz OUT.off
// Parameters as in ../shared/eval/peers.md.
#include <pcl/common/io.h>
#include <pcl/features/normal_3d.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>

#include <cmath>
#include <cstdio>
#include <exception>

#include "plain_files.h"

namespace {

constexpr int kNormalNeighbours = 20;
constexpr double kRadiusPerSpacing = 8.0;
constexpr double kPi = 3.14159265358979;

/// Mean distance to the nearest other point.
double spacing_of(const pcl::PointCloud<pcl::PointXYZ>::Ptr& cloud) {
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  std::vector<int> index(2);
  std::vector<float> squared(2);
  double sum = 0.0;
  for (const pcl::PointXYZ& point : *cloud) {
    tree.nearestKSearch(point, 2, index, squared);
    sum += std::sqrt(squared[1]);
  }
  return sum / static_cast<double>(cloud->size());
}

pcl::PointCloud<pcl::PointNormal>::Ptr with_normals(
    const pcl::PointCloud<pcl::PointXYZ>::Ptr& cloud) {
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(cloud);
  estimation.setSearchMethod(
      pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  estimation.setKSearch(kNormalNeighbours);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  pcl::PointCloud<pcl::PointNormal>::Ptr both(new pcl::PointCloud<pcl::PointNormal>);
  pcl::concatenateFields(*cloud, normals, *both);
  return both;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) throw std::runtime_error("usage: pcl_peer IN.xyz OUT.off");
  const std::vector<std::array<double, 3>> positions = read_xyz(argv[1]);
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (const auto& p : positions) {
    cloud->push_back(
        {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  }
  const auto input = with_normals(cloud);
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> projection;
  projection.setSearchRadius(kRadiusPerSpacing * spacing_of(cloud));
  projection.setMu(2.5);
  projection.setMaximumNearestNeighbors(100);
  projection.setMaximumSurfaceAngle(45.0 / 180.0 * kPi);
  projection.setMinimumAngle(10.0 / 180.0 * kPi);
  projection.setMaximumAngle(120.0 / 180.0 * kPi);
  projection.setNormalConsistency(false);
  projection.setInputCloud(input);
  projection.setSearchMethod(
      pcl::search::KdTree<pcl::PointNormal>::Ptr(new pcl::search::KdTree<pcl::PointNormal>));
  std::vector<pcl::Vertices> polygons;
  projection.reconstruct(polygons);
  std::vector<std::array<std::size_t, 3>> faces;
  for (const pcl::Vertices& polygon : polygons) {
    faces.push_back({static_cast<std::size_t>(polygon.vertices[0]),
                     static_cast<std::size_t>(polygon.vertices[1]),
                     static_cast<std::size_t>(polygon.vertices[2])});
  }
  write_off(argv[2], positions, faces);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "pcl_peer: %s\n", error.what());
  return 1;
}
