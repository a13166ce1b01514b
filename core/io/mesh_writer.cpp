#include <array>
#include <charconv>
#include <string_view>

#include "core/base/error.h"
#include "core/io/atomic_file.h"
#include "core/io/byte_order.h"
#include "core/io/file_bytes.h"
#include "core/io/mesh_file.h"
#include "core/io/text_fields.h"

namespace rangezip {

namespace {

constexpr std::size_t kPartsPerLook = 65536;  ///< numbers, between looks at whether to stop

/// Puts values into an AtomicFile as text or as little-endian bytes.
class MeshOutput {
 public:
  MeshOutput(const std::filesystem::path& path, const Progress& progress)
      : file_(path), progress_(progress) {}

  MeshOutput& text(std::string_view words) {
    if (++parts_ % kPartsPerLook == 0) progress_.check_stop();
    file_.write(words);
    return *this;
  }
  /// The shortest decimal that reads back as the same number, whatever the locale.
  template <class T>
  MeshOutput& number(T value) {
    std::array<char, 32> digits{};
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    return text({digits.data(), static_cast<std::size_t>(result.ptr - digits.data())});
  }
  MeshOutput& numbers(const Vec3& p) {
    return number(p.x).text(" ").number(p.y).text(" ").number(p.z);
  }
  template <class T>
  MeshOutput& bytes(T value) {
    const auto stored = little_bytes(value);
    return text({stored.data(), stored.size()});
  }
  void commit() {
    progress_.check_stop();
    file_.commit();
  }

 private:
  AtomicFile file_;
  const Progress& progress_;
  std::size_t parts_ = 0;  ///< written so far
};

void write_ply_header(MeshOutput& out, const TriangleMesh& mesh, const MeshFileOptions& options) {
  out.text("ply\nformat ").text(options.ascii ? "ascii" : "binary_little_endian");
  out.text(" 1.0\ncomment rangezip\nelement vertex ").number(mesh.positions.size());
  out.text("\nproperty double x\nproperty double y\nproperty double z\n");
  if (options.with_sources) out.text("property uint source_primitive\nproperty uint source_view\n");
  out.text("element face ").number(mesh.triangles.size());
  out.text("\nproperty list uchar uint vertex_indices\nend_header\n");
}

void write_ply_text(MeshOutput& out, const TriangleMesh& mesh, const MeshFileOptions& options) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    out.numbers(mesh.positions[i]);
    if (options.with_sources) {
      out.text(" ").number(mesh.sources[i].primitive).text(" ").number(mesh.sources[i].view);
    }
    out.text("\n");
  }
  for (const Triangle& triangle : mesh.triangles) {
    out.text("3 ").number(triangle[0]).text(" ").number(triangle[1]).text(" ");
    out.number(triangle[2]).text("\n");
  }
}

void write_ply_binary(MeshOutput& out, const TriangleMesh& mesh, const MeshFileOptions& options) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      out.bytes(mesh.positions[i][axis]);
    if (options.with_sources) out.bytes(mesh.sources[i].primitive).bytes(mesh.sources[i].view);
  }
  for (const Triangle& triangle : mesh.triangles) {
    out.bytes(std::uint8_t{3});
    for (const std::uint32_t corner : triangle)
      out.bytes(corner);
  }
}

void write_ply(MeshOutput& out, const TriangleMesh& mesh, const MeshFileOptions& options) {
  write_ply_header(out, mesh, options);
  options.ascii ? write_ply_text(out, mesh, options) : write_ply_binary(out, mesh, options);
}

void write_obj(MeshOutput& out, const TriangleMesh& mesh, const MeshFileOptions&) {
  out.text("# rangezip\n");
  for (const Vec3& p : mesh.positions)
    out.text("v ").numbers(p).text("\n");
  for (const Triangle& triangle : mesh.triangles) {
    out.text("f");
    for (const std::uint32_t corner : triangle)
      out.text(" ").number(std::uint64_t{corner} + 1);
    out.text("\n");
  }
}

void write_off(MeshOutput& out, const TriangleMesh& mesh, const MeshFileOptions&) {
  out.text("OFF\n").number(mesh.positions.size()).text(" ");
  out.number(mesh.triangles.size()).text(" 0\n");
  for (const Vec3& p : mesh.positions)
    out.numbers(p).text("\n");
  for (const Triangle& triangle : mesh.triangles) {
    out.text("3");
    for (const std::uint32_t corner : triangle)
      out.text(" ").number(corner);
    out.text("\n");
  }
}

std::array<Vec3, 3> corners_of(const TriangleMesh& mesh, const Triangle& triangle) {
  return {mesh.positions[triangle[0]], mesh.positions[triangle[1]], mesh.positions[triangle[2]]};
}

void write_stl_text(MeshOutput& out, const TriangleMesh& mesh) {
  out.text("solid rangezip\n");
  for (const Triangle& triangle : mesh.triangles) {
    const std::array<Vec3, 3> corners = corners_of(mesh, triangle);
    out.text("facet normal ")
        .numbers(unit_normal(corners[0], corners[1], corners[2]))
        .text("\nouter loop\n");
    for (const Vec3& p : corners)
      out.text("vertex ").numbers(p).text("\n");
    out.text("endloop\nendfacet\n");
  }
  out.text("endsolid rangezip\n");
}

void write_stl_binary(MeshOutput& out, const TriangleMesh& mesh) {
  constexpr std::size_t kHeaderSize = 80;
  std::string header = "binary STL by rangezip";  // must not begin with "solid"
  header.resize(kHeaderSize, ' ');
  out.text(header).bytes(static_cast<std::uint32_t>(mesh.triangles.size()));
  const auto put = [&out](const Vec3& v) {
    for (int axis = 0; axis < 3; ++axis)
      out.bytes(static_cast<float>(v[axis]));
  };
  for (const Triangle& triangle : mesh.triangles) {
    const std::array<Vec3, 3> corners = corners_of(mesh, triangle);
    put(unit_normal(corners[0], corners[1], corners[2]));
    for (const Vec3& p : corners)
      put(p);
    out.bytes(std::uint16_t{0});
  }
}

/// STL repeats the corners of every face, so readers join those with equal coordinates; in floats,
/// far from the origin, those of different vertices may be equal.
void check_fits_floats(const TriangleMesh& mesh, const std::filesystem::path& path) {
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const std::array<Vec3, 3> corners = corners_of(mesh, mesh.triangles[f]);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = corners[i], &b = corners[(i + 1) % 3];
      if (a == b || Vec3f(a) != Vec3f(b)) continue;
      throw IoError(path.string() + ": binary STL stores 32-bit floats, too coarse for face " +
                    std::to_string(f) + ", two corners of which would become one; " +
                    "write .ply, .obj or .off, or move the input nearer to the origin");
    }
  }
}

void write_stl(MeshOutput& out, const TriangleMesh& mesh, const MeshFileOptions& options) {
  options.ascii ? write_stl_text(out, mesh) : write_stl_binary(out, mesh);
}

using Writer = void (*)(MeshOutput&, const TriangleMesh&, const MeshFileOptions&);

/// @throws IoError for an unknown extension.
Writer writer_for(const std::filesystem::path& path) {
  const std::string extension = to_lower(path.extension().string());
  if (extension == ".ply") return write_ply;
  if (extension == ".obj") return write_obj;
  if (extension == ".off") return write_off;
  if (extension == ".stl") return write_stl;
  throw IoError(path.string() + ": a mesh is written as .ply, .obj, .off or .stl, not as " +
                quote(extension));
}

}  // namespace

void check_mesh_path(const std::filesystem::path& path) {
  writer_for(path);
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    throw IoError(path.string() + ": cannot be written: there is no folder " + folder.string());
  }
  if (std::filesystem::is_directory(path, error)) {
    throw IoError(path.string() + ": cannot be written: it is a folder");
  }
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh,
                const MeshFileOptions& options, const Progress& progress) {
  const Writer write = writer_for(path);
  if (options.with_sources && mesh.sources.size() != mesh.positions.size()) {
    throw InvalidArgument("write_mesh: with_sources needs one source per position, got " +
                          std::to_string(mesh.sources.size()) + " for " +
                          std::to_string(mesh.positions.size()));
  }
  if (write == &write_stl && !options.ascii) check_fits_floats(mesh, path);
  MeshOutput out(path, progress);
  write(out, mesh, options);
  out.commit();
}

}  // namespace rangezip
