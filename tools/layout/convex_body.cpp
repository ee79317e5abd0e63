// SPDX-License-Identifier: Apache-2.0
#include "tools/layout/convex_body.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "host/support/input_error.hpp"
#include "host/table/line_reader.hpp"
#include "host/table/table_reader.hpp"

namespace pharos::layout {
namespace {

constexpr double kMinSize_m = 0.005;
constexpr double kMaxSize_m = 12.0;  // as for targets: larger values are probably millimetres
constexpr double kFlatness = 1e-4;   // of the body's size: printed coordinates are rounded
constexpr double kSameDirection = 1.0 - 1e-8;
constexpr std::size_t kMaxVertices = 2000;  // a housing, not a scan: every face is checked against every vertex
constexpr std::size_t kMaxFaces = 4000;
constexpr const char* kBlank = " \t\r";

using Face = std::vector<std::size_t>;

struct Mesh {
  std::vector<Vector3> vertices;
  std::vector<Face> faces;
};

/// Words of an OFF file without comments.
class Words {
 public:
  explicit Words(const std::string& path) : lines_(host::ByteSource(path), host::LastLine::kAccept) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw host::InputError(lines_.name() + ": line " + std::to_string(lines_.line_number()) + ": " + what);
  }
  std::string_view next(const char* wanted) {
    while (trim().empty()) {
      const auto line = lines_.next();
      if (!line) fail(std::string("the file ends where ") + wanted + " should stand");
      rest_ = line->substr(0, line->find('#'));
    }
    const std::size_t length = std::min(rest_.find_first_of(kBlank), rest_.size());
    const std::string_view word = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return word;
  }
  double number(const char* wanted) { return parsed<double>(next(wanted), wanted); }
  std::size_t count(const char* wanted, std::size_t minimum, std::size_t maximum) {
    const auto value = parsed<std::size_t>(next(wanted), wanted);
    if (value < minimum || value > maximum) {
      fail(std::string(wanted) + ": " + std::to_string(value) + " is not from " + std::to_string(minimum) + " to " +
           std::to_string(maximum));
    }
    return value;
  }
  /// Colours after a face.
  void skip_line() { rest_ = {}; }

 private:
  std::string_view trim() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlank), rest_.size()));
    return rest_;
  }
  template <class Number>
  Number parsed(std::string_view word, const char* wanted) const {
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(static_cast<double>(value))) {
      fail(host::quoted(word) + " is no number where " + wanted + " should stand");
    }
    return value;
  }

  host::LineReader lines_;
  std::string_view rest_;
};

Mesh read_mesh(Words& words) {
  if (words.next("OFF") != "OFF") words.fail("not an OFF file: it starts with the word OFF");
  const std::size_t vertices = words.count("the number of vertices", 4, kMaxVertices);
  const std::size_t faces = words.count("the number of faces", 4, kMaxFaces);
  words.next("the number of edges");
  Mesh mesh;
  for (std::size_t i = 0; i < vertices; ++i) {
    const double x = words.number("a vertex's x");
    const double y = words.number("a vertex's y");
    mesh.vertices.emplace_back(x, y, words.number("a vertex's z"));
  }
  for (std::size_t i = 0; i < faces; ++i) {
    Face face(words.count("the number of a face's corners", 3, vertices));
    for (std::size_t& corner : face) corner = words.count("a face's corner", 0, vertices - 1);
    words.skip_line();
    mesh.faces.push_back(std::move(face));
  }
  return mesh;
}

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw host::InputError((path == "-" ? "standard input" : path) + ": " + what);
}

std::string face_name(std::size_t face) { return "face " + std::to_string(face) + " (counted from 0)"; }

void check_closed(const std::string& path, const Mesh& mesh) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> sides;  // directed side -> its face
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Face& face = mesh.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i) {
      const auto [at, fresh] = sides.insert({{face[i], face[(i + 1) % face.size()]}, f});
      if (!fresh) {
        refuse(path, face_name(f) + " and " + face_name(at->second) +
                         " run along a side in the same direction; turn one of them over");
      }
    }
  }
  for (const auto& [side, f] : sides) {
    if (!sides.contains({side.second, side.first})) {
      refuse(path, "not closed: nothing joins " + face_name(f) + " at the side from vertex " +
                       std::to_string(side.first) + " to " + std::to_string(side.second));
    }
  }
}

Vector3 area_vector(const Mesh& mesh, const Face& face) {
  Vector3 sum = Vector3::Zero();
  const Vector3& base = mesh.vertices[face[0]];
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    sum += 0.5 * (mesh.vertices[face[i]] - base).cross(mesh.vertices[face[i + 1]] - base);
  }
  return sum;
}

double volume_of(const Mesh& mesh) {
  double volume = 0.0;
  for (const Face& face : mesh.faces) volume += mesh.vertices[face[0]].dot(area_vector(mesh, face)) / 3.0;
  return volume;
}

Facet facet_of(const Mesh& mesh, const Vector3& normal, double offset_m, double tolerance_m) {
  Facet facet;
  facet.normal = normal;
  std::vector<Vector3> points;
  for (const Vector3& p : mesh.vertices) {
    if (std::abs(normal.dot(p) - offset_m) <= tolerance_m) points.push_back(p);
  }
  facet.origin.setZero();
  for (const Vector3& p : points) facet.origin += p / static_cast<double>(points.size());
  Eigen::Index minimum = 0;
  normal.cwiseAbs().minCoeff(&minimum);
  facet.u = normal.cross(Vector3::Unit(minimum)).normalized();
  facet.v = normal.cross(facet.u);
  for (const Vector3& p : points)
    facet.corners.emplace_back(facet.u.dot(p - facet.origin), facet.v.dot(p - facet.origin));
  std::sort(facet.corners.begin(), facet.corners.end(),
            [](const Vector2& a, const Vector2& b) { return std::atan2(a.y(), a.x()) < std::atan2(b.y(), b.x()); });
  return facet;
}

std::vector<Facet> facets_of(const std::string& path, const Mesh& mesh, double tolerance_m) {
  std::vector<Facet> facets;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vector3 area = area_vector(mesh, mesh.faces[f]);
    if (!(area.norm() > tolerance_m * tolerance_m)) refuse(path, face_name(f) + " has no area");
    const Vector3 normal = area.normalized();
    const double offset_m = normal.dot(mesh.vertices[mesh.faces[f][0]]);
    for (const std::size_t corner : mesh.faces[f]) {
      if (std::abs(normal.dot(mesh.vertices[corner]) - offset_m) > tolerance_m) {
        refuse(path, face_name(f) + " is not flat; divide it into triangles");
      }
    }
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      if (normal.dot(mesh.vertices[i]) - offset_m <= tolerance_m) continue;
      refuse(path, "not convex: vertex " + std::to_string(i) + " stands out before " + face_name(f) +
                       "; sensors could shadow each other. Give the convex part that carries them");
    }
    const bool known = std::any_of(facets.begin(), facets.end(),
                                   [&](const Facet& other) { return other.normal.dot(normal) > kSameDirection; });
    if (!known) facets.push_back(facet_of(mesh, normal, offset_m, tolerance_m));
  }
  return facets;
}

}  // namespace

ConvexBody read_body(const std::string& path) {
  Words words(path);
  const Mesh mesh = read_mesh(words);
  ConvexBody body;
  body.low = body.high = mesh.vertices.front();
  for (const Vector3& p : mesh.vertices) body.low = body.low.cwiseMin(p), body.high = body.high.cwiseMax(p);
  const double size_m = (body.high - body.low).maxCoeff();
  if (size_m < kMinSize_m || size_m > kMaxSize_m) {
    refuse(path, "the body is " + std::to_string(size_m) + " m long; 0.005 to 12 m can be: give metres");
  }
  check_closed(path, mesh);
  if (!(volume_of(mesh) > 0.0)) {
    refuse(path, "the faces look inwards; list their corners anticlockwise as seen from outside");
  }
  body.facets = facets_of(path, mesh, kFlatness * size_m);
  return body;
}

}  // namespace pharos::layout
