package org.collektive.stress;

import kotlin.Unit;
import org.collektive.runtime.PathNode;
import org.collektive.runtime.PathTree;
import org.openjdk.jcstress.annotations.Actor;
import org.openjdk.jcstress.annotations.Arbiter;
import org.openjdk.jcstress.annotations.Expect;
import org.openjdk.jcstress.annotations.JCStressTest;
import org.openjdk.jcstress.annotations.Outcome;
import org.openjdk.jcstress.annotations.State;
import org.openjdk.jcstress.infra.results.L_Result;
import org.openjdk.jcstress.infra.results.ZZ_Result;
import org.openjdk.jcstress.infra.results.Z_Result;

/** Rounds on two threads look up and create paths at the same time. */
public class PathTreeStress {
  private static PathNode child(PathTree tree, PathNode parent, Object token) {
    PathNode node = tree.find(parent, token);
    return node == null ? tree.enter(parent, token) : node;
  }

  @JCStressTest
  @Outcome(id = "true", expect = Expect.ACCEPTABLE, desc = "both threads get the same node")
  @Outcome(id = "false", expect = Expect.FORBIDDEN, desc = "one path has two nodes")
  @State
  public static class OnePathIsOneNode {
    private final PathTree tree = new PathTree();
    private PathNode first;
    private PathNode second;

    @Actor
    public void one() {
      first = child(tree, tree.getRoot(), "path");
    }

    @Actor
    public void other() {
      second = child(tree, tree.getRoot(), "path");
    }

    @Arbiter
    public void compare(Z_Result result) {
      result.r1 = first == second;
    }
  }

  /** The table already exists, so the racy write to its slot publishes the new node, not the volatile table. */
  @JCStressTest
  @Outcome(id = "absent", expect = Expect.ACCEPTABLE, desc = "the reader ran first")
  @Outcome(id = "complete", expect = Expect.ACCEPTABLE, desc = "all fields that the constructor wrote are visible")
  @Outcome(expect = Expect.FORBIDDEN, desc = "the node is visible before its fields")
  @State
  public static class FoundNodeIsComplete {
    private static final int HASH = new PathNode(new PathTree().getRoot(), "path").getHash();

    private final PathTree tree = new PathTree();
    private PathNode seen;

    public FoundNodeIsComplete() {
      tree.enter(tree.getRoot(), "sibling");
    }

    @Actor
    public void writer() {
      tree.enter(tree.getRoot(), "path");
    }

    /** Walks the table, because `find` skips a node whose hash is not visible. */
    @Actor
    public void reader(L_Result result) {
      tree.getRoot().getChildren().forEach(node -> {
        if (node.getToken() != "sibling") seen = node;
        return Unit.INSTANCE;
      });
      result.r1 = seen == null ? "absent" : missing(seen);
    }

    private String missing(PathNode node) {
      if (node.getToken() != "path") return "no token";
      if (node.getParent() != tree.getRoot()) return "no parent";
      if (node.getHash() != HASH || !node.matches(new String("path"), "path".hashCode())) return "no hash";
      return "complete";
    }
  }

  @JCStressTest
  @Outcome(id = "true, true", expect = Expect.ACCEPTABLE, desc = "existing paths are found while the table grows")
  @Outcome(expect = Expect.FORBIDDEN, desc = "a path was lost while the table grew")
  @State
  public static class GrowingTableLosesNothing {
    private final PathTree tree = new PathTree();
    private final PathNode first = tree.enter(tree.getRoot(), "first");
    private final PathNode second = tree.enter(tree.getRoot(), "second");

    @Actor
    public void writer() {
      for (int token = 0; token < 8; token++) tree.enter(tree.getRoot(), token);
    }

    @Actor
    public void reader(ZZ_Result result) {
      result.r1 = tree.find(tree.getRoot(), "first") == first;
      result.r2 = tree.find(tree.getRoot(), "second") == second;
    }
  }
}
