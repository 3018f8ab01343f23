// Bags of ROS 1: reading by their index, writing chunk by chunk.

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <gazelle/core.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <mutex>
#include <tuple>

namespace rosbag {

namespace {

const char kMagic[] = "#ROSBAG V2.0\n";
constexpr std::size_t kMagicSize = sizeof kMagic - 1;
constexpr std::size_t kFileHeaderSize = 4096;

enum Op : uint8_t {
  kMessage = 2,
  kFileHeader = 3,
  kIndex = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};

typedef std::map<std::string, std::string> Fields;
typedef std::vector<uint8_t> Bytes;

const char* nameOf(CompressionType compression) {
  return compression == compression::BZ2 ? "bz2" : compression == compression::LZ4 ? "lz4" : "none";
}

// ---- Numbers and fields

template <class T>
std::string packed(T value) {
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}
std::string packed(const ros::Time& time) { return packed(time.sec) + packed(time.nsec); }

template <class T>
T number(const Fields& fields, const char* name) {
  const auto found = fields.find(name);
  if (found == fields.end() || found->second.size() != sizeof(T))
    throw BagFormatException(std::string("Required '") + name + "' field missing or of wrong size");
  T value;
  std::memcpy(&value, found->second.data(), sizeof value);
  return value;
}
ros::Time timeOf(const Fields& fields, const char* name) {
  const uint64_t both = number<uint64_t>(fields, name);
  return ros::Time(static_cast<uint32_t>(both & 0xffffffffu), static_cast<uint32_t>(both >> 32));
}

std::string fieldsText(const Fields& fields) {
  std::string text;
  for (const auto& field : fields) {
    const std::string row = field.first + "=" + field.second;
    text += packed(static_cast<uint32_t>(row.size())) + row;
  }
  return text;
}

Fields parsedFields(const uint8_t* data, std::size_t size) {
  Fields fields;
  std::size_t at = 0;
  while (at < size) {
    uint32_t length = 0;
    if (size - at < 4) throw BagFormatException("Header field is cut off");
    std::memcpy(&length, data + at, 4);
    at += 4;
    if (length > size - at) throw BagFormatException("Header field is cut off");
    const char* const text = reinterpret_cast<const char*>(data + at);
    const void* const equals = std::memchr(text, '=', length);
    if (!equals) throw BagFormatException("Header field has no '='");
    const std::size_t name = static_cast<std::size_t>(static_cast<const char*>(equals) - text);
    fields[std::string(text, name)] = std::string(text + name + 1, length - name - 1);
    at += length;
  }
  return fields;
}

// A record among bytes.
struct Record {
  Fields header;
  const uint8_t* data = nullptr;
  uint32_t size = 0;
  std::size_t end = 0;
};

Record recordAt(const Bytes& bytes, std::size_t at) {
  const auto length = [&bytes](std::size_t place) {
    if (place > bytes.size() || bytes.size() - place < 4)
      throw BagFormatException("A record is cut off");
    uint32_t value;
    std::memcpy(&value, bytes.data() + place, 4);
    return value;
  };
  Record record;
  const uint32_t header = length(at);
  if (header > bytes.size() - at - 4) throw BagFormatException("A record is cut off");
  record.header = parsedFields(bytes.data() + at + 4, header);
  const std::size_t data = at + 4 + header;
  record.size = length(data);
  if (record.size > bytes.size() - data - 4) throw BagFormatException("A record is cut off");
  record.data = bytes.data() + data + 4;
  record.end = data + 4 + record.size;
  return record;
}

// ---- base64, for what goes to the host

const char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string toBase64(const Bytes& bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (i + j < bytes.size() ? bytes[i + j] : 0u);
    for (std::size_t j = 0; j < 4; ++j)
      text += i + j <= bytes.size() ? kAlphabet[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

Bytes fromBase64(const std::string& text) {
  static const std::vector<int> kValues = [] {
    std::vector<int> values(256, -1);
    for (int i = 0; i < 64; ++i) values[static_cast<uint8_t>(kAlphabet[i])] = i;
    return values;
  }();
  Bytes bytes;
  bytes.reserve(text.size() / 4 * 3);
  uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    const int value = kValues[static_cast<uint8_t>(c)];
    if (value < 0) continue;
    group = group << 6 | static_cast<uint32_t>(value);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes.push_back(static_cast<uint8_t>(group >> bits));
    }
  }
  return bytes;
}

Bytes repacked(const char* verb, const Bytes& data, const std::string& compression,
               std::size_t size) {
  try {
    return fromBase64(gazelle::call(verb, gazelle::Json::object({{"data", toBase64(data)},
                                                                 {"compression", compression},
                                                                 {"size", size}}))
                          .as_string());
  } catch (const gazelle::Error& error) {
    throw BagFormatException(error.what());
  }
}

struct ChunkInfo {
  uint64_t position = 0;
  ros::Time start, end;
  std::map<uint32_t, uint32_t> counts;
};

}  // namespace

struct Bag::Impl {
  std::string name;
  uint32_t mode = 0;
  std::FILE* file = nullptr;
  CompressionType compression = compression::Uncompressed;
  uint32_t threshold = 768 * 1024;
  std::vector<std::unique_ptr<ConnectionInfo> > connections;  // by their numbers
  std::map<uint32_t, std::vector<IndexEntry> > entries;       // by connection
  std::vector<ChunkInfo> chunks;
  // Of writing.
  std::map<std::tuple<std::string, std::string, std::string>, uint32_t> numbers;
  Bytes chunk;
  ChunkInfo chunk_info;
  std::map<uint32_t, std::vector<IndexEntry> > chunk_entries;
  // Of reading: the chunk that was read last.
  std::mutex mutex;
  uint64_t read_position = 0;
  Bytes read_chunk;

  ~Impl() {
    if (file) std::fclose(file);
  }

  bool writes() const { return (mode & (bagmode::Write | bagmode::Append)) != 0; }

  uint64_t tell() const { return static_cast<uint64_t>(ftello(file)); }
  void seek(uint64_t position) {
    if (fseeko(file, static_cast<off_t>(position), SEEK_SET) != 0)
      throw BagIOException("Error seeking in " + name);
  }
  void put(const void* data, std::size_t size) {
    if (size && std::fwrite(data, 1, size, file) != size)
      throw BagIOException("Error writing to " + name + ": " + std::strerror(errno));
  }
  Bytes get(std::size_t size) {
    Bytes bytes(size);
    if (size && std::fread(bytes.data(), 1, size, file) != size)
      throw BagIOException("Error reading from " + name + ": unexpected end of file");
    return bytes;
  }
  uint32_t getLength() {
    const Bytes bytes = get(4);
    uint32_t value;
    std::memcpy(&value, bytes.data(), 4);
    // A length that no file can have is a broken one: do not ask for the memory.
    const uint64_t here = tell();
    fseeko(file, 0, SEEK_END);
    const uint64_t end = tell();
    seek(here);
    if (value > end - here) throw BagFormatException("A record of " + name + " is cut off");
    return value;
  }
  Fields getFields() {
    const Bytes bytes = get(getLength());
    return parsedFields(bytes.data(), bytes.size());
  }
  static void append(Bytes& to, const std::string& text) {
    to.insert(to.end(), text.begin(), text.end());
  }
  static void appendRecord(Bytes& to, const Fields& header, const std::string& data) {
    const std::string text = fieldsText(header);
    append(to, packed(static_cast<uint32_t>(text.size())) + text);
    append(to, packed(static_cast<uint32_t>(data.size())) + data);
  }
  void putRecord(const Fields& header, const std::string& data) {
    Bytes bytes;
    appendRecord(bytes, header, data);
    put(bytes.data(), bytes.size());
  }

  // ---- Reading

  void readAll() {
    const Bytes magic = get(kMagicSize);
    if (std::memcmp(magic.data(), kMagic, kMagicSize) != 0)
      throw BagFormatException(name + " is no bag of format 2.0");
    const Fields header = getFields();
    const uint64_t index = number<uint64_t>(header, "index_pos");
    const uint32_t connection_count = number<uint32_t>(header, "conn_count");
    const uint32_t chunk_count = number<uint32_t>(header, "chunk_count");
    if (index == 0) throw BagUnindexedException();
    seek(index);
    for (uint32_t i = 0; i < connection_count; ++i) {
      const Fields fields = getFields();
      const Bytes data = get(getLength());
      addConnection(fields, data.data(), data.size());
    }
    for (uint32_t i = 0; i < chunk_count; ++i) {
      const Fields fields = getFields();
      const Bytes data = get(getLength());
      ChunkInfo info;
      info.position = number<uint64_t>(fields, "chunk_pos");
      info.start = timeOf(fields, "start_time");
      info.end = timeOf(fields, "end_time");
      for (std::size_t at = 0; at + 8 <= data.size(); at += 8) {
        uint32_t pair[2];
        std::memcpy(pair, data.data() + at, 8);
        info.counts[pair[0]] = pair[1];
      }
      chunks.push_back(info);
    }
    for (const ChunkInfo& info : chunks) readIndex(info);
    for (auto& list : entries) std::stable_sort(list.second.begin(), list.second.end());
  }

  void addConnection(const Fields& fields, const uint8_t* data, std::size_t size) {
    const uint32_t id = number<uint32_t>(fields, "conn");
    if (id > 1000000) throw BagFormatException("A connection's number is out of range");
    if (connections.size() <= id) connections.resize(id + 1);
    if (connections[id]) return;
    auto info = std::make_unique<ConnectionInfo>();
    info->id = id;
    const auto topic = fields.find("topic");
    if (topic != fields.end()) info->topic = topic->second;
    info->header = boost::make_shared<ros::M_string>();
    for (const auto& field : parsedFields(data, size)) (*info->header)[field.first] = field.second;
    info->datatype = (*info->header)["type"];
    info->md5sum = (*info->header)["md5sum"];
    info->msg_def = (*info->header)["message_definition"];
    connections[id] = std::move(info);
  }

  void readIndex(const ChunkInfo& info) {
    seek(info.position);
    const Fields header = getFields();
    if (number<uint8_t>(header, "op") != kChunk)
      throw BagFormatException("Expected a chunk in " + name);
    const uint64_t size = getLength();
    seek(tell() + size);
    for (std::size_t i = 0; i < info.counts.size(); ++i) {
      const Fields fields = getFields();
      const Bytes data = get(getLength());
      if (number<uint8_t>(fields, "op") != kIndex)
        throw BagFormatException("Expected the index of a chunk in " + name);
      std::vector<IndexEntry>& list = entries[number<uint32_t>(fields, "conn")];
      for (std::size_t at = 0; at + 12 <= data.size(); at += 12) {
        uint32_t row[3];
        std::memcpy(row, data.data() + at, 12);
        list.push_back(IndexEntry{ros::Time(row[0], row[1]), info.position, row[2]});
      }
    }
  }

  Bytes message(const IndexEntry& entry) {
    const std::lock_guard<std::mutex> lock(mutex);
    if (!file) throw BagException("The bag " + name + " is closed");
    // What waits to be written is no chunk of the file yet.
    const bool is_waiting = writes() && entry.chunk_pos == chunk_info.position && !chunk.empty();
    if (!is_waiting) loadChunk(entry.chunk_pos);
    const Bytes& bytes = is_waiting ? chunk : read_chunk;
    for (std::size_t at = entry.offset;;) {
      const Record record = recordAt(bytes, at);
      if (number<uint8_t>(record.header, "op") == kMessage)
        return Bytes(record.data, record.data + record.size);
      at = record.end;  // a connection in front of its first message
    }
  }

  void loadChunk(uint64_t position) {
    if (position == read_position && !read_chunk.empty()) return;
    const uint64_t here = tell();
    std::fflush(file);
    seek(position);
    const Fields header = getFields();
    if (number<uint8_t>(header, "op") != kChunk)
      throw BagFormatException("Expected a chunk in " + name);
    const auto found = header.find("compression");
    const std::string packing = found == header.end() ? "none" : found->second;
    const std::size_t size = number<uint32_t>(header, "size");
    Bytes data = get(getLength());
    if (packing != "none") data = repacked("bag/decompress", data, packing, size);
    read_chunk.swap(data);
    read_position = position;
    seek(here);
  }

  // ---- Writing

  std::string fileHeader(uint64_t index) const {
    uint32_t count = 0;
    for (const auto& connection : connections) count += connection ? 1 : 0;
    const Fields header{{"op", packed(static_cast<uint8_t>(kFileHeader))},
                        {"index_pos", packed(index)},
                        {"conn_count", packed(count)},
                        {"chunk_count", packed(static_cast<uint32_t>(chunks.size()))}};
    const std::string text = fieldsText(header);
    const std::size_t padding = kFileHeaderSize - text.size() - 8;
    return packed(static_cast<uint32_t>(text.size())) + text +
           packed(static_cast<uint32_t>(padding)) + std::string(padding, ' ');
  }

  void begin() {
    put(kMagic, kMagicSize);
    const std::string header = fileHeader(0);
    put(header.data(), header.size());
    chunk_info = ChunkInfo();
    chunk_info.position = tell();
  }

  // Goes on behind the last chunk of a bag that was read; its index is written anew at the end.
  void beginAgain() {
    uint64_t index = 0;
    seek(kMagicSize);
    index = number<uint64_t>(getFields(), "index_pos");
    seek(kMagicSize);
    const std::string header = fileHeader(0);
    put(header.data(), header.size());
    seek(index);
    chunk_info = ChunkInfo();
    chunk_info.position = index;
    for (const auto& connection : connections)
      if (connection)
        numbers[keyOf(connection->topic, connection->md5sum, connection->header)] = connection->id;
  }

  static std::tuple<std::string, std::string, std::string> keyOf(
      const std::string& topic, const std::string& md5sum,
      const boost::shared_ptr<ros::M_string>& header) {
    const auto caller = header ? header->find("callerid") : ros::M_string::iterator();
    const bool is_named = header && caller != header->end();
    return std::make_tuple(topic, md5sum, is_named ? caller->second : std::string());
  }

  static std::string connectionData(const ConnectionInfo& info) {
    return fieldsText(Fields(info.header->begin(), info.header->end()));
  }
  static Fields connectionHeader(const ConnectionInfo& info) {
    return Fields{{"op", packed(static_cast<uint8_t>(kConnection))},
                  {"conn", packed(info.id)},
                  {"topic", info.topic}};
  }

  void write(const std::string& topic, const ros::Time& time, const std::string& datatype,
             const std::string& md5sum, const std::string& definition,
             const boost::shared_ptr<ros::M_string>& header, const Bytes& bytes) {
    const std::lock_guard<std::mutex> lock(mutex);
    const auto key = keyOf(topic, md5sum, header);
    const auto known = numbers.find(key);
    uint32_t id = 0;
    if (known != numbers.end()) {
      id = known->second;
    } else {
      id = static_cast<uint32_t>(connections.size());
      numbers[key] = id;
      auto info = std::make_unique<ConnectionInfo>();
      info->id = id;
      info->topic = topic;
      info->datatype = datatype;
      info->md5sum = md5sum;
      info->msg_def = definition;
      info->header =
          header ? boost::make_shared<ros::M_string>(*header) : boost::make_shared<ros::M_string>();
      (*info->header)["topic"] = topic;
      (*info->header)["type"] = datatype;
      (*info->header)["md5sum"] = md5sum;
      (*info->header)["message_definition"] = definition;
      appendRecord(chunk, connectionHeader(*info), connectionData(*info));
      connections.push_back(std::move(info));
    }
    const IndexEntry entry{time, chunk_info.position, static_cast<uint32_t>(chunk.size())};
    const Fields record{{"op", packed(static_cast<uint8_t>(kMessage))},
                        {"conn", packed(id)},
                        {"time", packed(time)}};
    appendRecord(chunk, record, std::string(bytes.begin(), bytes.end()));
    if (chunk_info.counts.empty() || time < chunk_info.start) chunk_info.start = time;
    if (chunk_info.counts.empty() || time > chunk_info.end) chunk_info.end = time;
    ++chunk_info.counts[id];
    chunk_entries[id].push_back(entry);
    std::vector<IndexEntry>& all = entries[id];
    all.insert(std::upper_bound(all.begin(), all.end(), entry), entry);
    if (chunk.size() >= threshold) flushChunk();
  }

  void flushChunk() {
    if (chunk.empty()) return;
    const bool is_packed = compression != compression::Uncompressed;
    const Bytes data =
        is_packed ? repacked("bag/compress", chunk, nameOf(compression), chunk.size()) : Bytes();
    const Bytes& written = is_packed ? data : chunk;
    const Fields header{{"op", packed(static_cast<uint8_t>(kChunk))},
                        {"compression", nameOf(compression)},
                        {"size", packed(static_cast<uint32_t>(chunk.size()))}};
    putRecord(header, std::string(written.begin(), written.end()));
    for (auto& list : chunk_entries) {
      std::stable_sort(list.second.begin(), list.second.end());
      std::string rows;
      for (const IndexEntry& entry : list.second) rows += packed(entry.time) + packed(entry.offset);
      putRecord(Fields{{"op", packed(static_cast<uint8_t>(kIndex))},
                       {"conn", packed(list.first)},
                       {"ver", packed(static_cast<uint32_t>(1))},
                       {"count", packed(static_cast<uint32_t>(list.second.size()))}},
                rows);
    }
    chunks.push_back(chunk_info);
    chunk.clear();
    chunk_entries.clear();
    chunk_info = ChunkInfo();
    chunk_info.position = tell();
  }

  void finish() {
    flushChunk();
    const uint64_t index = tell();
    for (const auto& connection : connections)
      if (connection) putRecord(connectionHeader(*connection), connectionData(*connection));
    for (const ChunkInfo& info : chunks) {
      std::string rows;
      for (const auto& count : info.counts) rows += packed(count.first) + packed(count.second);
      putRecord(Fields{{"op", packed(static_cast<uint8_t>(kChunkInfo))},
                       {"ver", packed(static_cast<uint32_t>(1))},
                       {"chunk_pos", packed(info.position)},
                       {"start_time", packed(info.start)},
                       {"end_time", packed(info.end)},
                       {"count", packed(static_cast<uint32_t>(info.counts.size()))}},
                rows);
    }
    seek(kMagicSize);
    const std::string header = fileHeader(index);
    put(header.data(), header.size());
  }
};

Bag::Bag() : impl_(std::make_shared<Impl>()) {}
Bag::Bag(std::string const& filename, uint32_t mode) : impl_(std::make_shared<Impl>()) {
  open(filename, mode);
}
Bag::Bag(Bag&& other) : impl_(std::make_shared<Impl>()) { swap(other); }
Bag& Bag::operator=(Bag&& other) {
  swap(other);
  return *this;
}
void Bag::swap(Bag& other) { std::swap(impl_, other.impl_); }

Bag::~Bag() {
  try {
    close();
  } catch (const BagException& error) {
    gazelle::log(gazelle::Level::kError, error.what(), "ros.rosbag");
  }
}

void Bag::open(std::string const& filename, uint32_t mode) {
  close();
  const CompressionType compression = impl_->compression;
  const uint32_t threshold = impl_->threshold;
  impl_ = std::make_shared<Impl>();
  impl_->compression = compression;
  impl_->threshold = threshold;
  impl_->name = filename;
  impl_->mode = mode;
  const bool appends = (mode & bagmode::Append) != 0;
  const bool writes = (mode & bagmode::Write) != 0;
  impl_->file = std::fopen(filename.c_str(), appends ? "r+b" : writes ? "w+b" : "rb");
  // Appending to what is not there begins it.
  const bool begins = writes || (appends && !impl_->file && errno == ENOENT);
  if (begins && !impl_->file) impl_->file = std::fopen(filename.c_str(), "w+b");
  if (!impl_->file)
    throw BagIOException("Error opening file: " + filename + ": " + std::strerror(errno));
  try {
    if (begins) {
      impl_->begin();
    } else {
      impl_->readAll();
      if (appends) impl_->beginAgain();
    }
  } catch (...) {
    std::fclose(impl_->file);
    impl_->file = nullptr;
    throw;
  }
}

void Bag::close() {
  if (!impl_ || !impl_->file) return;
  struct Closed {
    Impl& impl;
    ~Closed() {
      std::fclose(impl.file);
      impl.file = nullptr;
    }
  } closed{*impl_};
  if (impl_->writes()) {
    impl_->finish();
    if (std::fflush(impl_->file) != 0)
      throw BagIOException("Error writing to " + impl_->name + ": " + std::strerror(errno));
  }
}

bool Bag::isOpen() const { return impl_->file != nullptr; }
std::string Bag::getFileName() const { return impl_->name; }
BagMode Bag::getMode() const { return static_cast<BagMode>(impl_->mode); }
uint64_t Bag::getSize() const {
  if (!impl_->file) return 0;
  const off_t here = ftello(impl_->file);
  fseeko(impl_->file, 0, SEEK_END);
  const off_t end = ftello(impl_->file);
  fseeko(impl_->file, here, SEEK_SET);
  return static_cast<uint64_t>(end);
}
void Bag::setCompression(CompressionType compression) {
  if (impl_->file && impl_->writes()) impl_->flushChunk();
  impl_->compression = compression;
}
CompressionType Bag::getCompression() const { return impl_->compression; }
void Bag::setChunkThreshold(uint32_t chunk_threshold) {
  if (impl_->file && impl_->writes()) impl_->flushChunk();
  impl_->threshold = chunk_threshold;
}
uint32_t Bag::getChunkThreshold() const { return impl_->threshold; }

void Bag::writeBytes(std::string const& topic, ros::Time const& time, std::string const& datatype,
                     std::string const& md5sum, std::string const& definition,
                     boost::shared_ptr<ros::M_string> const& header,
                     std::vector<uint8_t> const& bytes) {
  if (time < ros::TIME_MIN)
    throw BagException("Tried to insert a message with time less than ros::TIME_MIN");
  if (!impl_->file || !impl_->writes())
    throw BagException("Tried to write to a bag that is not open for it: " + impl_->name);
  impl_->write(topic, time, datatype, md5sum, definition, header, bytes);
}

// ---- Messages and views

std::vector<uint8_t> MessageInstance::read() const { return bag_->message(entry_); }
uint32_t MessageInstance::size() const { return static_cast<uint32_t>(read().size()); }

void View::addQuery(Bag const& bag, ros::Time const& start_time, ros::Time const& end_time) {
  addQuery(
      bag, [](ConnectionInfo const*) { return true; }, start_time, end_time);
}

void View::addQuery(Bag const& bag, Query query, ros::Time const& start_time,
                    ros::Time const& end_time) {
  if (!bag.isOpen()) throw BagException("Tried to add query to a bag that is not open");
  for (const auto& connection : bag.impl_->connections) {
    if (!connection || !query(connection.get())) continue;
    for (const IndexEntry& entry : bag.impl_->entries[connection->id])
      if (entry.time >= start_time && entry.time <= end_time)
        messages_.push_back(MessageInstance(connection.get(), entry, bag.impl_));
  }
  // Equal times stay in the order of the file.
  const auto place = [](const MessageInstance& one) {
    return std::make_tuple(one.entry_.time.toNSec(), one.bag_.get(), one.entry_.chunk_pos,
                           one.entry_.offset);
  };
  std::stable_sort(
      messages_.begin(), messages_.end(),
      [&place](const MessageInstance& a, const MessageInstance& b) { return place(a) < place(b); });
  if (reduce_overlap_)
    messages_.erase(std::unique(messages_.begin(), messages_.end(),
                                [&place](const MessageInstance& a, const MessageInstance& b) {
                                  return place(a) == place(b);
                                }),
                    messages_.end());
}

std::vector<ConnectionInfo const*> View::getConnections() {
  std::vector<ConnectionInfo const*> found;
  for (const MessageInstance& message : messages_)
    if (std::find(found.begin(), found.end(), message.connection_) == found.end())
      found.push_back(message.connection_);
  return found;
}
ros::Time View::getBeginTime() {
  return messages_.empty() ? ros::Time() : messages_.front().getTime();
}
ros::Time View::getEndTime() {
  return messages_.empty() ? ros::Time() : messages_.back().getTime();
}

}  // namespace rosbag
