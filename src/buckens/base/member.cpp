// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/member.h"

#include <stdexcept>

#include "buckens/base/field.h"

namespace buckens::base {

namespace {

[[noreturn]] void refuse(const MemberType& type, const char* function) {
  throw std::logic_error(std::string("members of type ") + type.id().name() + " have no " +
                         function);
}

}  // namespace

std::vector<Member> Member::parts() const {
  std::vector<Member> out;
  const std::size_t count = type->size(at);
  for (std::size_t k = 0; k < count; ++k) out.push_back(type->part(at, k));
  return out;
}

std::vector<Field> Member::fields() const { return type->fields(at); }

std::shared_ptr<void> MemberType::make() const {
  return {create(), [this](void* record) { destroy(record); }};
}

std::size_t MemberType::size(const void*) const { refuse(*this, "size"); }
Member MemberType::part(void*, std::size_t) const { refuse(*this, "part"); }
const MemberType& MemberType::part_type() const { refuse(*this, "part_type"); }
Member MemberType::add(void*, std::size_t) const { refuse(*this, "add"); }
void MemberType::take(void*, void*) const { refuse(*this, "take"); }
void MemberType::clear(void*) const { refuse(*this, "clear"); }
std::vector<AlternativeNote> MemberType::alternatives() const { refuse(*this, "alternatives"); }
std::size_t MemberType::index(const void*) const { refuse(*this, "index"); }
std::vector<std::string> MemberType::choices() const { refuse(*this, "choices"); }
std::vector<std::string> MemberType::planned() const { refuse(*this, "planned"); }
void MemberType::choose(void*, std::size_t) const { refuse(*this, "choose"); }
void* MemberType::create() const { refuse(*this, "create"); }
void MemberType::destroy(void*) const { refuse(*this, "destroy"); }
std::vector<Field> MemberType::fields(void*) const { refuse(*this, "fields"); }
SourceLocation* MemberType::where(void*) const { return nullptr; }
std::string* MemberType::name(void*) const { return nullptr; }

}  // namespace buckens::base
