using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>The page of the manual that the help button of a component opens, such as <c>programs.md#build</c>. Derived components inherit it.</summary>
    [AttributeUsage(AttributeTargets.Class)]
    internal sealed class HelpPageAttribute : HelpURLAttribute
    {
        internal HelpPageAttribute(string page) : base(page)
        {
        }

        /// <summary>The page from the folder of the manual.</summary>
        internal string Page => base.URL;

        /// <inheritdoc/>
        public override string URL => Installation.AddressOf(Page);
    }
}
