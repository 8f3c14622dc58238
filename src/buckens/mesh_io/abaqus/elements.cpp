// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/abaqus/elements.h"

#include <algorithm>
#include <array>

namespace buckens::mesh_io {

namespace {

using fem::CellKind;
using enum AbaqusRole;

constexpr std::string_view kHex = "hex8 with incompatible modes";
constexpr std::string_view kFull = "the same shape with full integration";
constexpr std::string_view kMixed = "the same shape in displacements alone, without pressure";
constexpr std::string_view kTet10 = "tet10";
constexpr std::string_view kTri = "the shell with 3 nodes";
constexpr std::string_view kQuad = "the shell with 4 nodes";
constexpr std::string_view kQuadratic = "the shell of this shape with full integration";
constexpr std::string_view kTimoshenko = "a straight Timoshenko beam with exact shape functions";
constexpr std::string_view kEuler = "a straight Euler-Bernoulli beam";
constexpr std::string_view kTwoBeams = "two straight Timoshenko beams in a chain";
constexpr std::string_view kTwoBars = "two straight bars in a chain";
constexpr std::string_view kSpring = "left out; attach springs and dampers in the model file";
constexpr std::string_view kWarm = "the same shape without temperature";
constexpr std::string_view kHeat = "the same shape as an element with stiffness";
constexpr std::string_view kWet = "the same shape without pore pressure";
constexpr std::string_view kPlaneBeam = "a straight Timoshenko beam in space";
constexpr std::string_view kFluid = "left out; there are no fluids";
constexpr std::string_view kPlane = "left out beside elements in space, and a shell elsewhere";
constexpr std::string_view kRigid = "left out; they only show a surface without mass";

constexpr AbaqusElementType kTypes[] = {
    {"C3D4", solid, CellKind::tet4, 4, ""},
    {"C3D4H", solid, CellKind::tet4, 4, kMixed},
    {"C3D5", solid, CellKind::pyramid5, 5, ""},
    {"C3D5H", solid, CellKind::pyramid5, 5, kMixed},
    {"C3D6", solid, CellKind::wedge6, 6, ""},
    {"C3D6H", solid, CellKind::wedge6, 6, kMixed},
    {"C3D6R", solid, CellKind::wedge6, 6, kFull},
    {"SC6R", solid, CellKind::wedge6, 6, "wedge6, a solid: too stiff where it is thin"},
    {"C3D8", solid, CellKind::hex8, 8, kHex},
    {"C3D8R", solid, CellKind::hex8, 8, kHex},
    {"C3D8I", solid, CellKind::hex8, 8, ""},
    {"C3D8H", solid, CellKind::hex8, 8, kHex},
    {"C3D8IH", solid, CellKind::hex8, 8, kHex},
    {"C3D8RH", solid, CellKind::hex8, 8, kHex},
    {"C3D8S", solid, CellKind::hex8, 8, kHex},
    {"C3D8HS", solid, CellKind::hex8, 8, kHex},
    {"SC8R", solid, CellKind::hex8, 8, kHex},
    {"CSS8", solid, CellKind::hex8, 8, kHex},
    {"C3D10", solid, CellKind::tet10, 10, ""},
    {"C3D10H", solid, CellKind::tet10, 10, kMixed},
    {"C3D10I", solid, CellKind::tet10, 10, kTet10},
    {"C3D10M", solid, CellKind::tet10, 10, kTet10},
    {"C3D10MH", solid, CellKind::tet10, 10, kTet10},
    {"C3D10HS", solid, CellKind::tet10, 10, kTet10},
    {"C3D10R", solid, CellKind::tet10, 10, kTet10},
    {"C3D10S", solid, CellKind::tet10, 10, kTet10},
    {"C3D10T", solid, CellKind::tet10, 10, kTet10},
    {"C3D15", solid, CellKind::wedge15, 15, ""},
    {"C3D15H", solid, CellKind::wedge15, 15, kMixed},
    {"C3D20", solid, CellKind::hex20, 20, ""},
    {"C3D20H", solid, CellKind::hex20, 20, kMixed},
    {"C3D20R", solid, CellKind::hex20, 20, kFull},
    {"C3D20RH", solid, CellKind::hex20, 20, kFull},
    {"C3D20RI", solid, CellKind::hex20, 20, kFull},
    {"C3D4T", solid, CellKind::tet4, 4, kWarm},
    {"C3D6T", solid, CellKind::wedge6, 6, kWarm},
    {"C3D6RT", solid, CellKind::wedge6, 6, kWarm},
    {"C3D8T", solid, CellKind::hex8, 8, kWarm},
    {"C3D8RT", solid, CellKind::hex8, 8, kWarm},
    {"C3D8HT", solid, CellKind::hex8, 8, kWarm},
    {"C3D8RHT", solid, CellKind::hex8, 8, kWarm},
    {"C3D10HT", solid, CellKind::tet10, 10, kWarm},
    {"C3D10MT", solid, CellKind::tet10, 10, kWarm},
    {"C3D10MHT", solid, CellKind::tet10, 10, kWarm},
    {"C3D15T", solid, CellKind::wedge15, 15, kWarm},
    {"C3D20T", solid, CellKind::hex20, 20, kWarm},
    {"C3D20RT", solid, CellKind::hex20, 20, kWarm},
    {"C3D20HT", solid, CellKind::hex20, 20, kWarm},
    {"C3D20RHT", solid, CellKind::hex20, 20, kWarm},
    {"SC6RT", solid, CellKind::wedge6, 6, kWarm},
    {"SC8RT", solid, CellKind::hex8, 8, kWarm},
    {"C3D4P", solid, CellKind::tet4, 4, kWet},
    {"C3D6P", solid, CellKind::wedge6, 6, kWet},
    {"C3D8P", solid, CellKind::hex8, 8, kWet},
    {"C3D8PT", solid, CellKind::hex8, 8, kWet},
    {"C3D8RP", solid, CellKind::hex8, 8, kWet},
    {"C3D10MP", solid, CellKind::tet10, 10, kWet},
    {"C3D20P", solid, CellKind::hex20, 20, kWet},
    {"C3D20RP", solid, CellKind::hex20, 20, kWet},
    {"DC3D4", solid, CellKind::tet4, 4, kHeat},
    {"DC3D5", solid, CellKind::pyramid5, 5, kHeat},
    {"DC3D6", solid, CellKind::wedge6, 6, kHeat},
    {"DC3D8", solid, CellKind::hex8, 8, kHeat},
    {"DC3D10", solid, CellKind::tet10, 10, kHeat},
    {"DC3D15", solid, CellKind::wedge15, 15, kHeat},
    {"DC3D20", solid, CellKind::hex20, 20, kHeat},

    {"S3", shell, CellKind::tri3, 3, kTri},
    {"S3R", shell, CellKind::tri3, 3, kTri},
    {"S3RS", shell, CellKind::tri3, 3, kTri},
    {"STRI3", shell, CellKind::tri3, 3, kTri},
    {"S4", shell, CellKind::quad4, 4, kQuad},
    {"S4R", shell, CellKind::quad4, 4, kQuad},
    {"S4R5", shell, CellKind::quad4, 4, kQuad},
    {"S4RS", shell, CellKind::quad4, 4, kQuad},
    {"S4RSW", shell, CellKind::quad4, 4, kQuad},
    {"S6", shell, CellKind::tri6, 6, kQuadratic},
    {"STRI65", shell, CellKind::tri6, 6, kQuadratic},
    {"S8", shell, CellKind::quad8, 8, kQuadratic},
    {"S8R", shell, CellKind::quad8, 8, kQuadratic},
    {"S8R5", shell, CellKind::quad8, 8, kQuadratic},
    {"US3", shell, CellKind::tri3, 3, kTri},
    {"US4", shell, CellKind::quad4, 4, kQuad},
    {"S3T", shell, CellKind::tri3, 3, kTri},
    {"S3RT", shell, CellKind::tri3, 3, kTri},
    {"S4T", shell, CellKind::quad4, 4, kQuad},
    {"S4RT", shell, CellKind::quad4, 4, kQuad},
    {"S8RT", shell, CellKind::quad8, 8, kQuadratic},
    {"DS3", shell, CellKind::tri3, 3, kHeat},
    {"DS4", shell, CellKind::quad4, 4, kHeat},
    {"DS6", shell, CellKind::tri6, 6, kHeat},
    {"DS8", shell, CellKind::quad8, 8, kHeat},

    {"B31", beam, CellKind::line2, 2, kTimoshenko},
    {"B31H", beam, CellKind::line2, 2, kTimoshenko},
    {"B31R", beam, CellKind::line2, 2, kTimoshenko},
    {"B31OS", beam, CellKind::line2, 2, "a straight Timoshenko beam without warping"},
    {"PIPE31", beam, CellKind::line2, 2, kTimoshenko},
    {"PIPE31H", beam, CellKind::line2, 2, kTimoshenko},
    {"B32", beam, CellKind::line3, 3, kTwoBeams},
    {"B32H", beam, CellKind::line3, 3, kTwoBeams},
    {"B32R", beam, CellKind::line3, 3, kTwoBeams},
    {"B32OS", beam, CellKind::line3, 3, kTwoBeams},
    {"B32OSH", beam, CellKind::line3, 3, kTwoBeams},
    {"B31OSH", beam, CellKind::line2, 2, "a straight Timoshenko beam without warping"},
    {"PIPE32", beam, CellKind::line3, 3, kTwoBeams},
    {"PIPE32H", beam, CellKind::line3, 3, kTwoBeams},
    {"PIPE22", beam, CellKind::line3, 3, kTwoBeams},
    {"B23", beam, CellKind::line2, 2, kEuler, false},
    {"B33", beam, CellKind::line2, 2, kEuler, false},
    {"B33H", beam, CellKind::line2, 2, kEuler, false},
    {"T3D2", bar, CellKind::line2, 2, ""},
    {"T3D2H", bar, CellKind::line2, 2, kMixed},
    {"T3D3", bar, CellKind::line3, 3, kTwoBars},
    {"B21", beam, CellKind::line2, 2, kPlaneBeam},
    {"B21H", beam, CellKind::line2, 2, kPlaneBeam},
    {"B22", beam, CellKind::line3, 3, kTwoBeams},
    {"B22H", beam, CellKind::line3, 3, kTwoBeams},
    {"PIPE21", beam, CellKind::line2, 2, kPlaneBeam},
    {"T2D2", bar, CellKind::line2, 2, ""},
    {"T2D3", bar, CellKind::line3, 3, kTwoBars},
    {"T3D2T", bar, CellKind::line2, 2, kWarm},

    {"MASS", mass, CellKind::point1, 1, ""},
    {"ROTARYI", rotary_inertia, CellKind::point1, 1, ""},

    {"CPS3", plane, CellKind::tri3, 3, kPlane},
    {"CPS3H", plane, CellKind::tri3, 3, kPlane},
    {"CPS3T", plane, CellKind::tri3, 3, kPlane},
    {"CPS4", plane, CellKind::quad4, 4, kPlane},
    {"CPS4R", plane, CellKind::quad4, 4, kPlane},
    {"CPS4I", plane, CellKind::quad4, 4, kPlane},
    {"CPS4H", plane, CellKind::quad4, 4, kPlane},
    {"CPS4RH", plane, CellKind::quad4, 4, kPlane},
    {"CPS4IH", plane, CellKind::quad4, 4, kPlane},
    {"CPS4T", plane, CellKind::quad4, 4, kPlane},
    {"CPS4RT", plane, CellKind::quad4, 4, kPlane},
    {"CPS6", plane, CellKind::tri6, 6, kPlane},
    {"CPS6M", plane, CellKind::tri6, 6, kPlane},
    {"CPS6H", plane, CellKind::tri6, 6, kPlane},
    {"CPS6MH", plane, CellKind::tri6, 6, kPlane},
    {"CPS8", plane, CellKind::quad8, 8, kPlane},
    {"CPS8R", plane, CellKind::quad8, 8, kPlane},
    {"CPS8H", plane, CellKind::quad8, 8, kPlane},
    {"CPS8RH", plane, CellKind::quad8, 8, kPlane},
    {"CPS8T", plane, CellKind::quad8, 8, kPlane},
    {"CPS8RT", plane, CellKind::quad8, 8, kPlane},
    {"CPE3", plane, CellKind::tri3, 3, kPlane},
    {"CPE3H", plane, CellKind::tri3, 3, kPlane},
    {"CPE3T", plane, CellKind::tri3, 3, kPlane},
    {"CPE4", plane, CellKind::quad4, 4, kPlane},
    {"CPE4R", plane, CellKind::quad4, 4, kPlane},
    {"CPE4I", plane, CellKind::quad4, 4, kPlane},
    {"CPE4H", plane, CellKind::quad4, 4, kPlane},
    {"CPE4RH", plane, CellKind::quad4, 4, kPlane},
    {"CPE4IH", plane, CellKind::quad4, 4, kPlane},
    {"CPE4T", plane, CellKind::quad4, 4, kPlane},
    {"CPE4RT", plane, CellKind::quad4, 4, kPlane},
    {"CPE6", plane, CellKind::tri6, 6, kPlane},
    {"CPE6M", plane, CellKind::tri6, 6, kPlane},
    {"CPE6H", plane, CellKind::tri6, 6, kPlane},
    {"CPE6MH", plane, CellKind::tri6, 6, kPlane},
    {"CPE8", plane, CellKind::quad8, 8, kPlane},
    {"CPE8R", plane, CellKind::quad8, 8, kPlane},
    {"CPE8H", plane, CellKind::quad8, 8, kPlane},
    {"CPE8RH", plane, CellKind::quad8, 8, kPlane},
    {"CPE8T", plane, CellKind::quad8, 8, kPlane},
    {"CPE8RT", plane, CellKind::quad8, 8, kPlane},
    {"CPEG3", plane, CellKind::tri3, 3, kPlane},
    {"CPEG3H", plane, CellKind::tri3, 3, kPlane},
    {"CPEG3T", plane, CellKind::tri3, 3, kPlane},
    {"CPEG4", plane, CellKind::quad4, 4, kPlane},
    {"CPEG4R", plane, CellKind::quad4, 4, kPlane},
    {"CPEG4I", plane, CellKind::quad4, 4, kPlane},
    {"CPEG4H", plane, CellKind::quad4, 4, kPlane},
    {"CPEG4RH", plane, CellKind::quad4, 4, kPlane},
    {"CPEG4IH", plane, CellKind::quad4, 4, kPlane},
    {"CPEG4T", plane, CellKind::quad4, 4, kPlane},
    {"CPEG4RT", plane, CellKind::quad4, 4, kPlane},
    {"CPEG6", plane, CellKind::tri6, 6, kPlane},
    {"CPEG6M", plane, CellKind::tri6, 6, kPlane},
    {"CPEG6H", plane, CellKind::tri6, 6, kPlane},
    {"CPEG6MH", plane, CellKind::tri6, 6, kPlane},
    {"CPEG8", plane, CellKind::quad8, 8, kPlane},
    {"CPEG8R", plane, CellKind::quad8, 8, kPlane},
    {"CPEG8H", plane, CellKind::quad8, 8, kPlane},
    {"CPEG8RH", plane, CellKind::quad8, 8, kPlane},
    {"CPEG8T", plane, CellKind::quad8, 8, kPlane},
    {"CPEG8RT", plane, CellKind::quad8, 8, kPlane},

    {"D", left_out, CellKind::point1, -1, kFluid},
    {"F3D4", left_out, CellKind::tet4, -1, kFluid},
    {"F3D6", left_out, CellKind::wedge6, -1, kFluid},
    {"F3D8", left_out, CellKind::hex8, -1, kFluid},
    {"F3D8R", left_out, CellKind::hex8, -1, kFluid},
    {"AC3D4", left_out, CellKind::tet4, -1, kFluid},
    {"AC3D6", left_out, CellKind::wedge6, -1, kFluid},
    {"AC3D8", left_out, CellKind::hex8, -1, kFluid},
    {"AC3D8R", left_out, CellKind::hex8, -1, kFluid},
    {"AC3D10", left_out, CellKind::tet10, -1, kFluid},
    {"AC3D20", left_out, CellKind::hex20, -1, kFluid},

    {"SPRING1", left_out, CellKind::point1, -1, kSpring},
    {"SPRING2", spring, CellKind::line2, 2, ""},
    {"SPRINGA", spring, CellKind::line2, 2, ""},
    {"DASHPOT1", left_out, CellKind::point1, -1, kSpring},
    {"DASHPOT2", left_out, CellKind::line2, -1, kSpring},
    {"DASHPOTA", left_out, CellKind::line2, -1, kSpring},
    {"CONN3D2", left_out, CellKind::line2, -1, "left out; write joints in the model file"},
    {"GAPUNI", left_out, CellKind::line2, -1, "left out; there is no contact inside a body"},
    {"R3D3", left_out, CellKind::tri3, -1, kRigid},
    {"R3D4", left_out, CellKind::quad4, -1, kRigid},
    {"RB3D2", left_out, CellKind::line2, -1, kRigid},
    {"SFM3D3", left_out, CellKind::tri3, -1, kRigid},
    {"SFM3D4", left_out, CellKind::quad4, -1, kRigid},
    {"SFM3D6", left_out, CellKind::tri6, -1, kRigid},
    {"SFM3D8", left_out, CellKind::quad8, -1, kRigid},
    {"SFM3D8R", left_out, CellKind::quad8, -1, kRigid},
    {"SFM3D4R", left_out, CellKind::quad4, -1, kRigid},
    {"R2D2", left_out, CellKind::line2, -1, kRigid},
    {"RB2D2", left_out, CellKind::line2, -1, kRigid},
    {"CONN2D2", left_out, CellKind::line2, -1, "left out; write joints in the model file"},
    {"HEATCAP", left_out, CellKind::point1, -1, "left out; it has no mass"},
    {"RAX2", left_out, CellKind::line2, -1, kRigid},
    {"F3D3", left_out, CellKind::tri3, -1, kFluid},
    {"DCOUP3D", left_out, CellKind::point1, 1, ""},
};

using Faces = std::vector<std::vector<int>>;

const Faces& faces_of(CellKind kind) {
  static const Faces tet = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  static const Faces pyramid = {{0, 1, 2, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}};
  static const Faces wedge = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  static const Faces hex = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
                            {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
  static const Faces none;
  switch (kind) {
    case CellKind::tet4:
    case CellKind::tet10:
      return tet;
    case CellKind::pyramid5:
      return pyramid;
    case CellKind::wedge6:
    case CellKind::wedge15:
      return wedge;
    case CellKind::hex8:
    case CellKind::hex20:
      return hex;
    default:
      return none;
  }
}

using Edge = std::array<int, 2>;

constexpr Edge kTriEdges[] = {{0, 1}, {1, 2}, {2, 0}};
constexpr Edge kQuadEdges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
constexpr Edge kTetEdges[] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
constexpr Edge kWedgeEdges[] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5},
                                {5, 3}, {0, 3}, {1, 4}, {2, 5}};
constexpr Edge kHexEdges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                              {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

}  // namespace

const AbaqusElementType* find_abaqus_element(std::string_view name) {
  const auto* found = std::find_if(std::begin(kTypes), std::end(kTypes),
                                   [&](const auto& type) { return type.name == name; });
  return found == std::end(kTypes) ? nullptr : found;
}

std::span<const std::vector<int>> abaqus_faces(CellKind kind) { return faces_of(kind); }

std::span<const std::array<int, 2>> abaqus_edges(CellKind kind) {
  switch (kind) {
    case CellKind::tri6:
      return kTriEdges;
    case CellKind::quad8:
      return kQuadEdges;
    case CellKind::tet10:
      return kTetEdges;
    case CellKind::wedge15:
      return kWedgeEdges;
    case CellKind::hex20:
      return kHexEdges;
    default:
      return {};
  }
}

}  // namespace buckens::mesh_io
