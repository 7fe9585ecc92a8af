#include "image/colours.hh"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

static const Primaries rec_709 = {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};

Curve colours_srgb() {
  return [](double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); };
}

Curve colours_power(double exponent) {
  if (exponent == 1) return nullptr;
  return [exponent](double x) { return std::pow(x, exponent); };
}

static Matrix product(const Matrix &a, const Matrix &b) {
  Matrix c{};
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      for (size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

/* By Cramer's rule. */
static Matrix inverse(const Matrix &m) {
  Matrix c{};
  double determinant = 0;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      c[j][i] = m[(i + 1) % 3][(j + 1) % 3] * m[(i + 2) % 3][(j + 2) % 3] -
                m[(i + 1) % 3][(j + 2) % 3] * m[(i + 2) % 3][(j + 1) % 3];
  for (size_t k = 0; k < 3; ++k) determinant += m[0][k] * c[k][0];
  for (auto &row : c)
    for (double &x : row) x /= determinant;
  return c;
}

/* RGB to XYZ, white having Y = 1. */
static Matrix to_xyz(const Primaries &p) {
  Matrix m{};
  for (size_t k = 0; k < 3; ++k) {
    m[0][k] = p[2 * k];
    m[1][k] = p[2 * k + 1];
    m[2][k] = 1 - p[2 * k] - p[2 * k + 1];
  }
  const double white[3] = {p[6] / p[7], 1, (1 - p[6] - p[7]) / p[7]};
  Matrix back = inverse(m);
  for (size_t k = 0; k < 3; ++k) {
    double scale = back[k][0] * white[0] + back[k][1] * white[1] + back[k][2] * white[2];
    for (size_t i = 0; i < 3; ++i) m[i][k] *= scale;
  }
  return m;
}

/* Sets the matrix unless it changes nothing but by the rounding in the file. */
static void set_matrix(Colours &colours, const Matrix &matrix) {
  double change = 0;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) {
      double difference = std::fabs(matrix[i][j] - double(i == j));
      if (!(difference < 1e6)) throw std::runtime_error("has primaries that span no colours");
      change = std::max(change, difference);
    }
  colours.mixes = change > 0.005;
  colours.matrix = matrix;
}

void colours_of_primaries(const Primaries &primaries, Colours &colours) {
  set_matrix(colours, product(inverse(to_xyz(rec_709)), to_xyz(primaries)));
}

void Colours::decode(double rgb[3], double step) const {
  double light[3];
  for (size_t k = 0; k < 3; ++k) light[k] = curves[k] ? curves[k](rgb[k]) : rgb[k];
  double room = std::max(step, 0.01 * *std::max_element(light, light + 3));
  for (size_t k = 0; k < 3; ++k) {
    rgb[k] = light[k];
    if (!mixes) continue;
    rgb[k] = matrix[k][0] * light[0] + matrix[k][1] * light[1] + matrix[k][2] * light[2];
    if (rgb[k] < 0 && rgb[k] >= -room) rgb[k] = 0;
  }
}

/* ---- ICC profiles ---- */

namespace {

struct Profile {
  const std::string &bytes;
  std::string name;

  [[noreturn]] void refuse(const char *why) const {
    throw std::runtime_error("has the colour profile '" + name + "', which " + why +
                             "; convert it to sRGB first");
  }
  uint32_t number(size_t at, size_t length) const {
    uint32_t sum = 0;
    if (at > bytes.size() || length > bytes.size() - at) refuse("is damaged");
    for (size_t k = 0; k < length; ++k) sum = sum << 8 | uint8_t(bytes[at + k]);
    return sum;
  }
  double fixed(size_t at) const {
    return int32_t(number(at, 4)) / 65536.0;
  }
  std::string word(size_t at) const {
    number(at, 4);
    return bytes.substr(at, 4);
  }
  size_t find(const char *tag) const { /* 0: not there */
    for (size_t k = 0, count = number(128, 4); k < count; ++k)
      if (word(132 + 12 * k) == tag) return number(136 + 12 * k, 4);
    return 0;
  }
  size_t need(const char *tag) const {
    size_t at = find(tag);
    if (at == 0) refuse("has no matrix and curves");
    return at;
  }
  Curve curve(size_t at) const;
  Curve parametric(size_t at) const;
};

/* Section 10.16 of ICC.1:2010. */
Curve Profile::parametric(size_t at) const {
  static const size_t counts[] = {1, 3, 4, 5, 7};
  uint32_t type = number(at + 8, 2);
  if (type > 4) refuse("has a curve of an unknown type");
  double p[7] = {1, 1, 0, 0, 0, 0, 0}; /* g a b c d e f */
  for (size_t k = 0; k < counts[type]; ++k) p[k] = fixed(at + 12 + 4 * k);
  double g = p[0], a = p[1], b = p[2], c = p[3], d = p[4], e = p[5], f = p[6];
  if ((type == 1 || type == 2) && a == 0) refuse("is damaged");
  if (type == 1 || type == 2) {
    d = -b / a;
    e = f = type == 2 ? c : 0;
    c = 0;
  }
  if (type == 0) d = 0;
  return [=](double x) { return x >= d ? std::pow(std::max(a * x + b, 0.0), g) + e : c * x + f; };
}

Curve Profile::curve(size_t at) const {
  if (word(at) == "para") return parametric(at);
  if (word(at) != "curv") refuse("has a curve of an unknown type");
  size_t count = number(at + 8, 4);
  if (count == 0) return nullptr;
  if (count == 1) return colours_power(number(at + 12, 2) / 256.0);
  std::vector<double> table;
  for (size_t k = 0; k < count; ++k) table.push_back(number(at + 12 + 2 * k, 2) / 65535.0);
  return [table](double x) {
    double place = std::min(std::max(x, 0.0), 1.0) * double(table.size() - 1);
    size_t k = std::min(size_t(place), table.size() - 2);
    return table[k] + (place - double(k)) * (table[k + 1] - table[k]);
  };
}

} // namespace

/* Are they sRGB's but for rounding? Then they are taken for it, bit by bit. */
static bool is_srgb(const std::array<Curve, 3> &curves) {
  Curve srgb = colours_srgb();
  for (const Curve &curve : curves)
    for (int k = 0; k <= 32; ++k)
      if (std::fabs((curve ? curve(k / 32.0) : k / 32.0) - srgb(k / 32.0)) > 0.002) return false;
  return true;
}

Colours colours_of_profile(const std::string &icc, const std::string &name) {
  /* Rec. 709's primaries under D50, by Bradford's adaptation, as ICC profiles hold them */
  static const Matrix pcs_709 = {{{{0.4360747, 0.3850649, 0.1430804}},
                                  {{0.2225045, 0.7168786, 0.0606169}},
                                  {{0.0139322, 0.0971045, 0.7141733}}}};
  Profile profile = {icc, name.empty() ? "without a name" : name};
  std::string space = profile.word(16);
  Colours colours;
  if (profile.word(36) != "acsp") profile.refuse("is damaged");
  if (space != "RGB " && space != "GRAY") profile.refuse("is for neither RGB nor grey");
  if (profile.find("A2B0")) profile.refuse("is made of tables");
  if (profile.word(20) != "XYZ ") profile.refuse("does not lead to XYZ");
  if (space == "GRAY") {
    colours.curves.fill(profile.curve(profile.need("kTRC")));
  } else {
    static const char *const curves[] = {"rTRC", "gTRC", "bTRC"};
    static const char *const columns[] = {"rXYZ", "gXYZ", "bXYZ"};
    Matrix matrix{};
    for (size_t k = 0; k < 3; ++k) {
      size_t column = profile.need(columns[k]);
      for (size_t i = 0; i < 3; ++i) matrix[i][k] = profile.fixed(column + 8 + 4 * i);
      colours.curves[k] = profile.curve(profile.need(curves[k]));
    }
    set_matrix(colours, product(inverse(pcs_709), matrix));
  }
  if (is_srgb(colours.curves)) colours.curves.fill(colours_srgb());
  return colours;
}
