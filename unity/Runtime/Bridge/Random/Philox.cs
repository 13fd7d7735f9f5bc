namespace Collektive.Bridge
{
    /// <summary>
    /// The counter-based generator Philox4x32-10 (Salmon, Moraes, Dror, Shaw: Parallel random numbers, as easy as 1, 2, 3; SC 2011). The JVM uses the same
    /// generator. Both implementations are tested with the authors' test vectors.
    /// </summary>
    internal static class Philox
    {
        private const uint Multiplier0 = 0xD2511F53;
        private const uint Multiplier1 = 0xCD9E8D57;
        private const uint Weyl0 = 0x9E3779B9;
        private const uint Weyl1 = 0xBB67AE85;
        private const int Rounds = 10;

        /// <summary>Replaces the four words of the counter with four random words.</summary>
        public static void Block(ulong key, ref uint c0, ref uint c1, ref uint c2, ref uint c3)
        {
            var k0 = (uint)key;
            var k1 = (uint)(key >> 32);
            for (var round = 0; round < Rounds; round++)
            {
                var product0 = (ulong)Multiplier0 * c0;
                var product1 = (ulong)Multiplier1 * c2;
                c0 = (uint)(product1 >> 32) ^ c1 ^ k0;
                c1 = (uint)product1;
                c2 = (uint)(product0 >> 32) ^ c3 ^ k1;
                c3 = (uint)product0;
                k0 = unchecked(k0 + Weyl0);
                k1 = unchecked(k1 + Weyl1);
            }
        }
    }
}
