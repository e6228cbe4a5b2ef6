// SPDX-License-Identifier: Apache-2.0
#include "semantic/xml/validating_reader.h"

#include <libxml/parser.h>
#include <libxml/xmlschemas.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>

#include "core/base/error.h"

namespace oikos::semantic {

namespace {

constexpr std::size_t kMaxFindings = 1000;
constexpr int kMaxDepth = 32;
constexpr std::int64_t kMaxFileBytes = std::int64_t{1} << 30;

struct Free {
  void operator()(xmlParserCtxt* parser) const { xmlFreeParserCtxt(parser); }
  void operator()(xmlSchemaValidCtxt* validator) const { xmlSchemaFreeValidCtxt(validator); }
  void operator()(xmlSchema* schema) const { xmlSchemaFree(schema); }
  void operator()(xmlSchemaParserCtxt* context) const { xmlSchemaFreeParserCtxt(context); }
};

std::string_view view(const xmlChar* text) {
  return text == nullptr ? std::string_view() : std::string_view(reinterpret_cast<const char*>(text));
}

bool isOneOf(std::string_view text, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

/// The file as libxml2 reads it: by itself it would fetch URLs and unpack archives.
class Input {
 public:
  Input(std::istream& stream, std::string where) : stream_(stream), where_(std::move(where)) {}

  /// 0 at the end, or where it went wrong.
  int read(char* buffer, int size) {
    stream_.read(buffer, size);
    bytes_ += stream_.gcount();
    failed_ = failed_ || stream_.bad();
    return failed_ || bytes_ > kMaxFileBytes ? 0 : static_cast<int>(stream_.gcount());
  }

  void throwIfFailed() const {
    if (failed_) {
      throw base::Error(base::ErrorCode::kIo, "cannot be read to its end", where_);
    }
    if (bytes_ > kMaxFileBytes) {
      throw base::Error(base::ErrorCode::kInput, "larger than 1 GiB", where_);
    }
  }

 private:
  std::istream& stream_;
  std::string where_;
  std::int64_t bytes_ = 0;
  bool failed_ = false;
};

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '.' || text.back() == ' ')) {
    text.pop_back();
  }
  return text;
}

/// libxml2 says "Element 'room', attribute 'id': [facet 'pattern'] The value … is not accepted … . Expected is ( … )."
Finding fromMessage(int line, std::string message) {
  Finding finding{Severity::kError, line, "document", {}, {}};
  message = trimmed(std::move(message));
  if (message.starts_with("Element '")) {
    if (const auto colon = message.find(": "); colon != std::string::npos) {
      finding.element = "e" + message.substr(1, colon - 1);
      message.erase(0, colon + 2);
    }
  }
  if (const auto expected = message.find("Expected is "); expected != std::string::npos) {
    finding.expected = message.substr(expected + 12);
    message = trimmed(message.substr(0, expected));
  }
  finding.found = std::move(message);
  return finding;
}

/// One pass of libxml2's SAX2 parser with its schema validator plugged in between.
class Session {
 public:
  Session(const Input& input, std::string_view schema, const ElementHandler& handler)
      : handler_(handler), input_(input), schema_(parse(schema)), validator_(xmlSchemaNewValidCtxt(schema_.get())) {
    OIKOS_CHECK(validator_ != nullptr);
    sax_.initialized = XML_SAX2_MAGIC;
    sax_.startElementNs = &Session::startElement;
    sax_.endElementNs = &Session::endElement;
    sax_.characters = &Session::characters;
    sax_.internalSubset = &Session::documentType;
    xmlSAXHandler* sax = &sax_;
    void* user = this;
    xmlSchemaSetValidStructuredErrors(validator_.get(), &Session::report, this);
    plug_ = xmlSchemaSAXPlug(validator_.get(), &sax, &user);
    OIKOS_CHECK(plug_ != nullptr);
    parser_.reset(xmlCreatePushParserCtxt(sax, user, nullptr, 0, nullptr));
    OIKOS_CHECK(parser_ != nullptr);
    // Only the five predefined entities can come up, as a document type stops the parser; without NOENT an ampersand would stay "&#38;".
    xmlCtxtUseOptions(parser_.get(), XML_PARSE_NONET | XML_PARSE_NOENT);
  }
  ~Session() { xmlSchemaSAXUnplug(plug_); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  XmlReading run() {
    const ErrorChannel channel(&Session::report, this);
    std::array<char, 65536> buffer{};
    int size = 0;
    while (!stopped_ && (size = input_.read(buffer.data(), static_cast<int>(buffer.size()))) > 0) {
      xmlParseChunk(parser_.get(), buffer.data(), size, 0);
      stopped_ = stopped_ || parser_->wellFormed == 0;
    }
    input_.throwIfFailed();
    if (!stopped_) {
      xmlParseChunk(parser_.get(), nullptr, 0, 1);
      refuseOtherEncodings();
    }
    return {!stopped_ && parser_->wellFormed != 0, std::move(findings_)};
  }

 private:
  /// Errors of the parser itself come through a channel of the thread.
  struct ErrorChannel {
    ErrorChannel(xmlStructuredErrorFunc report, void* user) { xmlSetStructuredErrorFunc(user, report); }
    ~ErrorChannel() { xmlSetStructuredErrorFunc(nullptr, nullptr); }
    ErrorChannel(const ErrorChannel&) = delete;
    ErrorChannel& operator=(const ErrorChannel&) = delete;
  };

  static std::unique_ptr<xmlSchema, Free> parse(std::string_view schema) {
    const std::unique_ptr<xmlSchemaParserCtxt, Free> context(xmlSchemaNewMemParserCtxt(schema.data(), static_cast<int>(schema.size())));
    OIKOS_CHECK(context != nullptr);
    std::unique_ptr<xmlSchema, Free> parsed(xmlSchemaParse(context.get()));
    OIKOS_CHECK(parsed != nullptr);
    return parsed;
  }

  static void report(void* self, xmlErrorPtr error) {
    auto& session = *static_cast<Session*>(self);
    const bool of_schema = error->domain == XML_FROM_SCHEMASV;
    Finding finding = fromMessage(of_schema || error->line <= 0 ? session.line() : error->line,
                                  error->message == nullptr ? "unknown error" : error->message);
    if (!session.repeats(finding)) {
      session.add(std::move(finding));
    }
  }

  /// After the facet that a value breaks libxml2 names the type that it is not a value of.
  [[nodiscard]] bool repeats(const Finding& finding) const {
    return finding.found.find("is not a valid value of the") != std::string::npos && !findings_.empty() &&
           findings_.back().line == finding.line && findings_.back().element == finding.element;
  }

  static void documentType(void* self, const xmlChar* /*name*/, const xmlChar* /*external_id*/, const xmlChar* /*system_id*/) {
    auto& session = *static_cast<Session*>(self);
    session.add({Severity::kError, session.line(), "document type", "a DOCTYPE", "none: no entities, nothing from elsewhere"});
    session.stop();
  }

  /// Elements are written back into the bytes that were read, hence one encoding.
  void refuseOtherEncodings() {
    const std::string_view encoding = view(parser_->encoding);
    if (!encoding.empty() && !isOneOf(encoding, {"UTF-8", "utf-8", "ASCII", "US-ASCII", "us-ascii"})) {
      findings_.push_back({Severity::kError, 1, "document", "encoding '" + std::string(encoding) + "'", "UTF-8"});
    }
  }

  static void startElement(void* self, const xmlChar* name, const xmlChar* /*prefix*/, const xmlChar* /*uri*/, int /*namespaces*/,
                           const xmlChar** /*namespace_list*/, int attributes, int /*defaulted*/, const xmlChar** list) {
    auto& session = *static_cast<Session*>(self);
    session.attributes_.clear();
    for (int i = 0; i < attributes; ++i) {
      const xmlChar** const a = list + static_cast<std::ptrdiff_t>(5) * i;  // name, prefix, URI, value, its end
      session.attributes_.emplace_back(view(a[0]),
                                       std::string_view(reinterpret_cast<const char*>(a[3]), reinterpret_cast<const char*>(a[4])));
    }
    session.handOn(view(name));
  }

  static void endElement(void* self, const xmlChar* name, const xmlChar* /*prefix*/, const xmlChar* /*uri*/) {
    auto& session = *static_cast<Session*>(self);
    --session.depth_;
    session.handler_.text(view(name), session.text_);
    session.text_.clear();
  }

  static void characters(void* self, const xmlChar* text, int length) {
    auto& session = *static_cast<Session*>(self);
    session.text_.append(reinterpret_cast<const char*>(text), static_cast<std::size_t>(length));
  }

  void handOn(std::string_view name) {
    text_.clear();
    handler_.element({name, line(), depth_, attributes_});
    if (++depth_ > kMaxDepth) {
      add({Severity::kError, line(), "element '" + std::string(name) + "'", "nested " + std::to_string(depth_) + " deep",
           "at most " + std::to_string(kMaxDepth)});
      stop();
    }
  }

  void add(Finding finding) {
    if (stopped_) {
      return;
    }
    findings_.push_back(std::move(finding));
    if (findings_.size() >= kMaxFindings) {
      findings_.push_back({Severity::kError, line(), "document", "too many errors, the rest was not read", {}});
      stop();
    }
  }

  void stop() {
    stopped_ = true;
    xmlStopParser(parser_.get());
  }

  [[nodiscard]] int line() const { return parser_ == nullptr || parser_->input == nullptr ? 0 : parser_->input->line; }

  const ElementHandler& handler_;
  std::vector<Finding> findings_;
  std::vector<std::pair<std::string_view, std::string_view>> attributes_;
  std::string text_;
  int depth_ = 0;
  bool stopped_ = false;
  Input input_;
  xmlSAXHandler sax_{};
  std::unique_ptr<xmlSchema, Free> schema_;
  std::unique_ptr<xmlSchemaValidCtxt, Free> validator_;
  xmlSchemaSAXPlugStruct* plug_ = nullptr;
  std::unique_ptr<xmlParserCtxt, Free> parser_;
};

}  // namespace

XmlReading readValidated(std::istream& input, const std::string& where, std::string_view schema, const ElementHandler& handler) {
  return Session(Input(input, where), schema, handler).run();
}

}  // namespace oikos::semantic
