using System;
using System.Collections.Generic;
using System.Reflection;
using System.Reflection.Emit;

namespace Collektive.Headless
{
    /// <summary>Reads the instructions of a compiled method.</summary>
    internal static class Instructions
    {
        private const byte TwoBytes = 0xfe;

        private static readonly Dictionary<short, OpCode> Codes = ReadCodes();

        /// <summary>Returns the instructions in order, each with its operand if that has four bytes, such as the token of a member.</summary>
        internal static IEnumerable<KeyValuePair<OpCode, int>> Of(byte[] body)
        {
            for (var at = 0; at < body.Length;)
            {
                var code = body[at] == TwoBytes ? Codes[(short)(TwoBytes << 8 | body[at + 1])] : Codes[body[at]];
                at += code.Size;
                var size = SizeOfOperand(code.OperandType, body, at);
                yield return new KeyValuePair<OpCode, int>(code, size == 4 ? BitConverter.ToInt32(body, at) : 0);
                at += size;
            }
        }

        private static int SizeOfOperand(OperandType type, byte[] body, int at)
        {
            switch (type)
            {
                case OperandType.InlineNone: return 0;
                case OperandType.ShortInlineBrTarget:
                case OperandType.ShortInlineI:
                case OperandType.ShortInlineVar: return 1;
                case OperandType.InlineVar: return 2;
                case OperandType.InlineI8:
                case OperandType.InlineR: return 8;
                case OperandType.InlineSwitch: return 4 + 4 * BitConverter.ToInt32(body, at);
                default: return 4;
            }
        }

        private static Dictionary<short, OpCode> ReadCodes()
        {
            var codes = new Dictionary<short, OpCode>();
            foreach (var field in typeof(OpCodes).GetFields(BindingFlags.Public | BindingFlags.Static))
            {
                var code = (OpCode)field.GetValue(null);
                codes[code.Value] = code;
            }
            return codes;
        }
    }
}
