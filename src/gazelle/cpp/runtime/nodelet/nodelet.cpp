// Nodelets, their threads, and what loads them.

#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <nodelet/loader.h>
#include <nodelet/nodelet.h>
#include <pluginlib/class_loader.h>
#include <ros/callback_queue.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

namespace nodelet {

// ---- Nodelet

Nodelet::Nodelet() : inited_(false), st_queue_(NULL), mt_queue_(NULL) {}
Nodelet::~Nodelet() {}

void Nodelet::init(const std::string& name, const M_string& remapping_args, const V_string& my_argv,
                   ros::CallbackQueueInterface* st_queue, ros::CallbackQueueInterface* mt_queue) {
  if (inited_) throw MultipleInitializationException();
  nodelet_name_ = name;
  my_argv_ = my_argv;
  st_queue_ = st_queue;
  mt_queue_ = mt_queue;
  const std::string parent = ros::names::parentNamespace(name);
  private_nh_.reset(new ros::NodeHandle(name, remapping_args));
  mt_private_nh_.reset(new ros::NodeHandle(name, remapping_args));
  nh_.reset(new ros::NodeHandle(parent, remapping_args));
  mt_nh_.reset(new ros::NodeHandle(parent, remapping_args));
  private_nh_->setCallbackQueue(st_queue);
  nh_->setCallbackQueue(st_queue);
  mt_private_nh_->setCallbackQueue(mt_queue);
  mt_nh_->setCallbackQueue(mt_queue);
  NODELET_DEBUG("Nodelet initializing");
  inited_ = true;
  onInit();
}

ros::NodeHandle& Nodelet::checked(const boost::scoped_ptr<ros::NodeHandle>& handle,
                                  const char* what) const {
  if (!inited_) throw UninitializedException(what);
  return *handle;
}
ros::NodeHandle& Nodelet::getNodeHandle() const { return checked(nh_, "getNodeHandle"); }
ros::NodeHandle& Nodelet::getPrivateNodeHandle() const {
  return checked(private_nh_, "getPrivateNodeHandle");
}
ros::NodeHandle& Nodelet::getMTNodeHandle() const { return checked(mt_nh_, "getMTNodeHandle"); }
ros::NodeHandle& Nodelet::getMTPrivateNodeHandle() const {
  return checked(mt_private_nh_, "getMTPrivateNodeHandle");
}
ros::CallbackQueueInterface& Nodelet::getSTCallbackQueue() const {
  if (!inited_) throw UninitializedException("getSTCallbackQueue");
  return *st_queue_;
}
ros::CallbackQueueInterface& Nodelet::getMTCallbackQueue() const {
  if (!inited_) throw UninitializedException("getMTCallbackQueue");
  return *mt_queue_;
}

namespace {

// A nodelet's queue in the threads of all: each callback is a turn in the common queue. Of a
// serial one only one callback runs at a time.
class SharedQueue : public ros::CallbackQueueInterface {
 public:
  SharedQueue(ros::CallbackQueue& pool, bool is_serial)
      : pool_(pool), state_(boost::make_shared<State>(is_serial)) {}
  ~SharedQueue() override { pool_.removeByID(id()); }

  void addCallback(const ros::CallbackInterfacePtr& callback, uint64_t owner_id) override {
    state_->own.addCallback(callback, owner_id);
    pool_.addCallback(boost::make_shared<Turn>(state_), id());
  }
  void removeByID(uint64_t owner_id) override { state_->own.removeByID(owner_id); }

 private:
  struct State {
    explicit State(bool serial) : is_serial(serial) {}
    ros::CallbackQueue own;
    const bool is_serial;
    std::atomic<bool> is_busy{false};
  };
  class Turn : public ros::CallbackInterface {
   public:
    explicit Turn(const boost::shared_ptr<State>& state) : state_(state) {}
    bool ready() override { return !state_->is_serial || !state_->is_busy; }
    CallResult call() override {
      if (state_->is_serial && state_->is_busy.exchange(true)) return TryAgain;
      struct Done {
        State& state;
        ~Done() { state.is_busy = false; }
      } done{*state_};
      return state_->own.callOne() == ros::CallbackQueue::TryAgain ? TryAgain : Success;
    }

   private:
    const boost::shared_ptr<State> state_;
  };

  uint64_t id() const { return reinterpret_cast<uint64_t>(state_.get()); }

  ros::CallbackQueue& pool_;
  const boost::shared_ptr<State> state_;
};

// One that is loaded; what it is made of goes after it.
struct Loaded {
  Loaded(ros::CallbackQueue& pool, const boost::shared_ptr<Nodelet>& made)
      : st_queue(pool, true), mt_queue(pool, false), nodelet(made) {}
  SharedQueue st_queue, mt_queue;
  boost::shared_ptr<Nodelet> nodelet;
};

}  // namespace

// ---- Loader

struct Loader::Impl {
  typedef boost::function<boost::shared_ptr<Nodelet>(const std::string&)> Create;

  std::mutex mutex;
  ros::CallbackQueue pool;
  std::unique_ptr<ros::AsyncSpinner> threads;
  std::unique_ptr<pluginlib::ClassLoader<Nodelet> > plugins;
  Create create;
  std::map<std::string, std::unique_ptr<Loaded> > nodelets;
  ros::NodeHandle node{"~"};
  ros::CallbackQueue api_queue;
  std::unique_ptr<ros::AsyncSpinner> api_thread;
  ros::ServiceServer load_server, unload_server, list_server;

  void begin(const ros::NodeHandle& server_nh) {
    int count = 0;
    server_nh.param("num_worker_threads", count, 0);
    threads.reset(new ros::AsyncSpinner(static_cast<uint32_t>(std::max(count, 0)), &pool));
    threads->start();
  }
  void usePlugins() {
    plugins.reset(new pluginlib::ClassLoader<Nodelet>("nodelet", "nodelet::Nodelet"));
    create = [this](const std::string& type) { return plugins->createInstance(type); };
  }

  void offer(const ros::NodeHandle& server_nh, Loader& loader) {
    node = server_nh;
    node.setCallbackQueue(&api_queue);
    load_server = node.advertiseService<NodeletLoad::Request, NodeletLoad::Response>(
        "load_nodelet", [&loader](NodeletLoad::Request& request, NodeletLoad::Response& response) {
          M_string remappings;
          const std::size_t count =
              std::min(request.remap_source_args.size(), request.remap_target_args.size());
          for (std::size_t i = 0; i < count; ++i)
            remappings[ros::names::resolve(request.remap_source_args[i])] =
                ros::names::resolve(request.remap_target_args[i]);
          response.success = loader.load(request.name, request.type, remappings, request.my_argv);
          return response.success != 0;
        });
    unload_server = node.advertiseService<NodeletUnload::Request, NodeletUnload::Response>(
        "unload_nodelet",
        [&loader](NodeletUnload::Request& request, NodeletUnload::Response& response) {
          response.success = loader.unload(request.name);
          if (!response.success)
            ROS_ERROR("Failed to find nodelet with name '%s' to unload.", request.name.c_str());
          return response.success != 0;
        });
    list_server = node.advertiseService<NodeletList::Request, NodeletList::Response>(
        "list", [&loader](NodeletList::Request&, NodeletList::Response& response) {
          response.nodelets = loader.listLoadedNodelets();
          return true;
        });
    api_thread.reset(new ros::AsyncSpinner(1, &api_queue));
    api_thread->start();
  }
};

Loader::Loader(bool provide_ros_api) : impl_(new Impl) {
  impl_->usePlugins();
  impl_->begin(impl_->node);
  if (provide_ros_api) impl_->offer(ros::NodeHandle("~"), *this);
}

Loader::Loader(const ros::NodeHandle& server_nh) : impl_(new Impl) {
  impl_->usePlugins();
  impl_->begin(server_nh);
  impl_->offer(server_nh, *this);
}

Loader::Loader(const boost::function<boost::shared_ptr<Nodelet>(const std::string&)>& create)
    : impl_(new Impl) {
  impl_->create = create;
  impl_->begin(impl_->node);
}

Loader::~Loader() {
  impl_->load_server.shutdown();
  impl_->unload_server.shutdown();
  impl_->list_server.shutdown();
  if (impl_->api_thread) impl_->api_thread->stop();
  clear();
  impl_->threads->stop();
}

bool Loader::load(const std::string& name, const std::string& type, const M_string& remappings,
                  const V_string& my_argv) {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  if (impl_->nodelets.count(name) != 0) {
    ROS_ERROR("Cannot load nodelet %s for one exists with that name already", name.c_str());
    return false;
  }
  boost::shared_ptr<Nodelet> nodelet;
  try {
    nodelet = impl_->create(type);
  } catch (const std::exception& error) {
    ROS_ERROR("Failed to load nodelet [%s] of type [%s]: %s", name.c_str(), type.c_str(),
              error.what());
    return false;
  }
  if (!nodelet) return false;
  ROS_DEBUG("Done loading nodelet %s", name.c_str());
  auto loaded = std::make_unique<Loaded>(impl_->pool, nodelet);
  Loaded& kept = *loaded;
  impl_->nodelets[name] = std::move(loaded);
  try {
    M_string resolved;
    for (const auto& pair : remappings)
      resolved[ros::names::resolve(pair.first)] = ros::names::resolve(pair.second);
    nodelet->init(name, resolved, my_argv, &kept.st_queue, &kept.mt_queue);
  } catch (const std::exception& error) {
    impl_->nodelets.erase(name);
    ROS_ERROR("Failed to initialize nodelet [%s] of type [%s]: %s", name.c_str(), type.c_str(),
              error.what());
    return false;
  }
  return true;
}

bool Loader::unload(const std::string& name) {
  std::unique_ptr<Loaded> ended;
  {
    const std::lock_guard<std::mutex> lock(impl_->mutex);
    const auto found = impl_->nodelets.find(name);
    if (found == impl_->nodelets.end()) return false;
    ended = std::move(found->second);
    impl_->nodelets.erase(found);
  }
  ended->nodelet.reset();
  return true;
}

bool Loader::clear() {
  std::map<std::string, std::unique_ptr<Loaded> > ended;
  {
    const std::lock_guard<std::mutex> lock(impl_->mutex);
    ended.swap(impl_->nodelets);
  }
  for (auto& nodelet : ended) nodelet.second->nodelet.reset();
  return true;
}

std::vector<std::string> Loader::listLoadedNodelets() {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  std::vector<std::string> found;
  for (const auto& nodelet : impl_->nodelets) found.push_back(nodelet.first);
  return found;
}

}  // namespace nodelet
