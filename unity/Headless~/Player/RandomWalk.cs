using Collektive.Bridge;
using Collektive.Unity;

namespace Collektive.Headless
{
    /// <summary>Provides the random numbers of a node's movement.</summary>
    public static class RandomWalk
    {
        /// <summary>Creates the stream of a node. It depends only on the seed and the id, not on the rounds, in which sensors use Node.Random.</summary>
        public static RandomStream StreamOf(Node node) => new RandomStream(SimulationManager.Current.Simulation.Seed, node.Id, RandomPurpose.Movement);
    }
}
