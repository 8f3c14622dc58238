// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/load_model.h"

#include "buckens/model_file/model_file.h"

namespace buckens::model_file {

std::unique_ptr<model::BuiltModel> load_model(const std::filesystem::path& path,
                                              const std::vector<std::string>& overrides) {
  return model::build_model(read_model_file(path, overrides));
}

}  // namespace buckens::model_file
