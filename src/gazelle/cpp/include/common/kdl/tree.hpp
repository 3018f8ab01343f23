// Trees of segments.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "kdl/chain.hpp"

namespace KDL {

class TreeElement;
typedef std::map<std::string, TreeElement> SegmentMap;

class TreeElement {
 public:
  Segment segment;
  unsigned int q_nr = 0;  // of its joint, where that moves
  SegmentMap::const_iterator parent;
  std::vector<SegmentMap::const_iterator> children;

  TreeElement(const Segment& segment_in, const SegmentMap::const_iterator& parent_in,
              unsigned int q_nr_in)
      : segment(segment_in), q_nr(q_nr_in), parent(parent_in) {}
  static TreeElement Root(const std::string& root_name) { return TreeElement(root_name); }

 private:
  explicit TreeElement(const std::string& name) : segment(name) {}
};

inline const std::vector<SegmentMap::const_iterator>& GetTreeElementChildren(
    const TreeElement& element) {
  return element.children;
}
inline SegmentMap::const_iterator GetTreeElementParent(const TreeElement& element) {
  return element.parent;
}
inline unsigned int GetTreeElementQNr(const TreeElement& element) { return element.q_nr; }
inline const Segment& GetTreeElementSegment(const TreeElement& element) { return element.segment; }

class GAZELLE_KDL Tree {
 public:
  explicit Tree(const std::string& root_name = "root");
  Tree(const Tree& other);
  Tree& operator=(const Tree& other);

  // False where there is no such hook, or the name is taken.
  bool addSegment(const Segment& segment, const std::string& hook_name);
  bool addChain(const Chain& chain, const std::string& hook_name);
  bool addTree(const Tree& tree, const std::string& hook_name);
  unsigned int getNrOfJoints() const { return joints_; }
  unsigned int getNrOfSegments() const { return static_cast<unsigned int>(segments_.size()) - 1; }
  SegmentMap::const_iterator getSegment(const std::string& name) const {
    return segments_.find(name);
  }
  SegmentMap::const_iterator getRootSegment() const { return segments_.find(root_); }
  // From root to tip, up and down again where they lie in two branches.
  bool getChain(const std::string& chain_root, const std::string& chain_tip, Chain& chain) const;
  const SegmentMap& getSegments() const { return segments_; }

 private:
  bool add_all(SegmentMap::const_iterator root, const std::string& hook_name);

  SegmentMap segments_;
  std::string root_;
  unsigned int joints_ = 0;
};

}  // namespace KDL
