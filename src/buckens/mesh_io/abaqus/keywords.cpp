// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/abaqus/keywords.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace buckens::mesh_io {

namespace {

constexpr std::string_view kSilent[] = {"HEADING", "PREPRINT", "ENDASSEMBLY", "PHYSICALCONSTANTS",
                                        "NOTES"};

constexpr std::string_view kElsewhere[] = {"BOUNDARY",
                                           "AMPLITUDE",
                                           "INITIALCONDITIONS",
                                           "CLOAD",
                                           "DLOAD",
                                           "DSLOAD",
                                           "BASEMOTION",
                                           "SUBMODEL",
                                           "TEMPERATURE",
                                           "FIELD",
                                           "PREDEFINEDFIELD",
                                           "VALUESATINFINITY",
                                           "PRE-TENSIONSECTION",
                                           "DESIGNVARIABLES",
                                           "DESIGNRESPONSE",
                                           "OBJECTIVE",
                                           "CONSTRAINT",
                                           "TIMEPOINTS",
                                           "RESTART",
                                           "OUTPUT",
                                           "NODEPRINT",
                                           "ELPRINT",
                                           "NODEFILE",
                                           "ELFILE",
                                           "NODEOUTPUT",
                                           "ELEMENTOUTPUT",
                                           "CONTACTPRINT",
                                           "CONTACTFILE",
                                           "FILEFORMAT",
                                           "SECTIONPRINT",
                                           "FILTER",
                                           "PARAMETER",
                                           "DESIGNPARAMETER",
                                           "SENSITIVITY",
                                           "USEREFINEDMESH",
                                           "REFINEMESH"};

constexpr std::string_view kWeightless[] = {"CONTACT",
                                            "CONTACTINCLUSIONS",
                                            "CONTACTEXCLUSIONS",
                                            "CONTACTPROPERTYASSIGNMENT",
                                            "CONTACTINITIALIZATIONASSIGNMENT",
                                            "CONTACTINITIALIZATIONDATA",
                                            "CONTACTFORMULATION",
                                            "CONTACTCONTROLS",
                                            "CONTACTSTABILIZATION",
                                            "CONTACTINTERFERENCE",
                                            "CONTACTDAMPING",
                                            "SURFACEPROPERTYASSIGNMENT",
                                            "SURFACESMOOTHING",
                                            "FRICTION",
                                            "CHANGEFRICTION",
                                            "COHESIVEBEHAVIOR",
                                            "CLEARANCE",
                                            "GAP",
                                            "GAPCONDUCTANCE",
                                            "GAPHEATGENERATION",
                                            "GAPRADIATION",
                                            "CONDUCTIVITY",
                                            "SPECIFICHEAT",
                                            "LATENTHEAT",
                                            "EXPANSION",
                                            "EMISSIVITY",
                                            "RADIATEFILM",
                                            "FILMPROPERTY",
                                            "CAVITYDEFINITION",
                                            "FLUIDCONSTANTS",
                                            "FLUIDSECTION",
                                            "FLUIDPROPERTY",
                                            "FLUIDDENSITY",
                                            "FLUIDBEHAVIOR",
                                            "FLUIDCAVITY",
                                            "SPECIFICGASCONSTANT",
                                            "NETWORKMPC",
                                            "ELECTRICALCONDUCTIVITY",
                                            "MAGNETICPERMEABILITY",
                                            "PIEZOELECTRIC",
                                            "DIELECTRIC",
                                            "INCIDENTWAVEINTERACTIONPROPERTY",
                                            "IMPEDANCEPROPERTY",
                                            "SECTIONCONTROLS",
                                            "HOURGLASSSTIFFNESS",
                                            "TRANSVERSESHEARSTIFFNESS",
                                            "TRANSVERSESHEAR",
                                            "SECTIONPOINTS",
                                            "DISTRIBUTIONTABLE",
                                            "RIGIDSURFACE",
                                            "CONNECTORSECTION",
                                            "CONNECTORBEHAVIOR",
                                            "CONNECTORELASTICITY",
                                            "CONNECTORDAMPING",
                                            "CONNECTORSTOP",
                                            "CONNECTORLOCK",
                                            "CONNECTORFRICTION",
                                            "USERELEMENT",
                                            "USERSECTION",
                                            "MEMBRANESECTION",
                                            "SURFACESECTION",
                                            "COHESIVESECTION",
                                            "GASKETSECTION",
                                            "DASHPOT",
                                            "DEPVAR",
                                            "USEROUTPUTVARIABLES",
                                            "ANNEALTEMPERATURE",
                                            "NODALENERGYRATE",
                                            "IMPERFECTION",
                                            "MAPSOLUTION",
                                            "ADAPTIVEMESH",
                                            "ADAPTIVEMESHCONTROLS",
                                            "MODELCHANGE"};

constexpr std::string_view kNonlinear[] = {"PLASTIC",
                                           "CREEP",
                                           "CYCLICHARDENING",
                                           "DEFORMATIONPLASTICITY",
                                           "RATEDEPENDENT",
                                           "DAMAGEINITIATION",
                                           "DAMAGEEVOLUTION",
                                           "DAMAGESTABILIZATION",
                                           "MOHRCOULOMB",
                                           "MOHRCOULOMBHARDENING",
                                           "DRUCKERPRAGER",
                                           "DRUCKERPRAGERHARDENING",
                                           "HYPERELASTIC",
                                           "HYPERFOAM",
                                           "VISCOELASTIC",
                                           "VISCO",
                                           "TRS",
                                           "CONCRETE",
                                           "CONCRETEDAMAGEDPLASTICITY",
                                           "CONCRETECOMPRESSIONHARDENING",
                                           "CONCRETETENSIONSTIFFENING",
                                           "TENSIONSTIFFENING",
                                           "FAILURERATIOS",
                                           "CRUSHABLEFOAM",
                                           "CRUSHABLEFOAMHARDENING",
                                           "CAPPLASTICITY",
                                           "CAPHARDENING",
                                           "POTENTIAL",
                                           "POROUSMETALPLASTICITY",
                                           "USERMATERIAL",
                                           "NOCOMPRESSION",
                                           "NOTENSION",
                                           "FAILSTRESS",
                                           "FAILSTRAIN",
                                           "MULLINSEFFECT",
                                           "EOS",
                                           "ANISOTROPICHYPERELASTIC",
                                           "SHEARFAILURE",
                                           "TENSILEFAILURE",
                                           "HYPOELASTIC",
                                           "SWELLING",
                                           "CASTIRONPLASTICITY"};

constexpr std::string_view kPeriodic[] = {"CYCLICSYMMETRYMODEL", "SYMMETRICMODELGENERATION",
                                          "SYMMETRICRESULTSTRANSFER"};

constexpr std::string_view kHolding[] = {"EMBEDDEDELEMENT",
                                         "NONSTRUCTURALMASS",
                                         "SHELLTOSOLIDCOUPLING",
                                         "FASTENER",
                                         "FASTENERPROPERTY",
                                         "RELEASE",
                                         "JOINT",
                                         "BUSHING",
                                         "MATRIXASSEMBLE",
                                         "MATRIXINPUT",
                                         "SUBSTRUCTUREPROPERTY",
                                         "SUBSTRUCTUREPATH",
                                         "REBAR",
                                         "REBARLAYER",
                                         "BEAMADDEDINERTIA",
                                         "BEAMSECTIONOFFSET",
                                         "CENTROID",
                                         "SHEARCENTER",
                                         "NMAP"};

template <std::size_t n>
bool is_among(const std::string_view (&list)[n], const std::string& name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

}  // namespace

KeywordRole role_of_keyword(const std::string& name) {
  if (is_among(kSilent, name)) return KeywordRole::silent;
  if (is_among(kElsewhere, name)) return KeywordRole::elsewhere;
  if (is_among(kWeightless, name)) return KeywordRole::weightless;
  if (is_among(kNonlinear, name)) return KeywordRole::nonlinear;
  if (is_among(kPeriodic, name)) return KeywordRole::periodic;
  if (is_among(kHolding, name)) return KeywordRole::holding;
  return KeywordRole::unknown;
}

}  // namespace buckens::mesh_io
